//! `servo_tcp`: the tool centre point is driven to a pose, or to a position, by differential inverse
//! kinematics in the loop: at every step of the simulation the error and the Jacobian are those of
//! the measured joint positions. There is no plan, so the end is known only in the run.
//!
//! The loop adjusts the setpoint of the joint controller. It integrates the changes that reduce the error
//! instead of starting from the measured positions, so that an arm that sags under its controller still reaches
//! the target. For the same reason the setpoint continues to change, up to the joint limits, if an obstacle
//! stops the arm: checks detect that, the servo does not.

use congruent_description::{ArmQ, Robot, RobotDescription, RobotQ};
use congruent_input::Diagnostic;
use congruent_kinematics::{Arm, ArmJoint, DifferentialMethod, IkSolver, KinematicsError, TargetPart};
use congruent_scenario::{ServoMethod, ServoMotion};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::tcp_move;
use crate::{Motion, MotionLimits, MotionPlan, TcpServo, motion_plan::SetpointMut, planning::Planning};

/// Default gain, 1/s: an error falls to 1/e in 0.2 s.
pub const DEFAULT_GAIN_PER_S: f64 = 5.0;

/// The result of a servo motion at its end.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ServoResult {
    /// Number of the motion in the scenario, from 1.
    pub motion: usize,
    /// Method by which joint velocities were computed from the error.
    pub method: ServoMethod,
    /// Remaining distance of the tool centre point to the target.
    pub position_m: f64,
    /// Remaining angle to the target orientation; `None` if the target has no orientation.
    pub orientation_rad: Option<f64>,
    /// Names of the joints that are at a position limit.
    pub limits_held: Vec<String>,
}

pub(crate) fn plan(settings: &ServoMotion, planning: &Planning<'_>) -> Result<Motion, Diagnostic> {
    let place = planning.place.key("servo_tcp");
    let (_, target) = tcp_move::target(&settings.servo_tcp, place, planning)?;
    let servo = TcpServo {
        target,
        method: settings.method,
        gain_per_s: settings.gain_per_s.unwrap_or(DEFAULT_GAIN_PER_S),
    };
    Ok(Motion { duration_s: settings.duration_s, motion_plan: MotionPlan::Servo(Box::new(servo)) })
}

/// Computes the steps of a servo without allocation.
#[derive(Debug, Clone)]
pub(crate) struct ServoController<'a> {
    robot: &'a Robot,
    limits: &'a MotionLimits,
    solver: IkSolver,
    measured: ArmQ,
    commanded: ArmQ,
    change: Vec<f64>,
    /// The setpoint of all joints before the step.
    before: RobotQ,
}

/// A step, and the part of it that lies within the motion.
pub(crate) struct StepInterval {
    pub(crate) step_s: f64,
    pub(crate) moved_s: f64,
}

impl<'a> ServoController<'a> {
    /// A controller whose setpoints keep the velocity limits and the declared accelerations.
    pub(crate) fn new(
        description: &'a RobotDescription,
        limits: &'a MotionLimits,
    ) -> Result<Self, KinematicsError> {
        let arm = Arm::from_description(description)?;
        let joints = arm.joints().len();
        Ok(Self {
            robot: &description.robot,
            limits,
            solver: IkSolver::new(arm),
            measured: ArmQ::zeros(joints),
            commanded: ArmQ::zeros(joints),
            change: vec![0.0; joints],
            before: RobotQ::zeros(description.robot.dof()),
        })
    }

    /// Moves the setpoint `q` by one step towards the target, within the position limits of the joints. If a velocity limit
    /// is exceeded, all joints are scaled down by one factor, so that the direction is kept; the change of their speeds
    /// likewise if it exceeds a declared acceleration. `qd` is the mean velocity over the last step on entry, over this step
    /// on return.
    pub(crate) fn advance(
        &mut self,
        servo: &TcpServo,
        measured_q: &RobotQ,
        StepInterval { step_s, moved_s }: StepInterval,
        SetpointMut { q, qd, .. }: SetpointMut<'_>,
    ) -> Result<(), KinematicsError> {
        // The motion is over: its last step may end after it, with the setpoint at rest.
        if moved_s <= 0.0 {
            qd.fill(0.0);
            return Ok(());
        }
        self.copy_arm(measured_q, q);
        let method = differential_method(servo.method);
        let step = self.solver.change_towards(&servo.target, &self.measured, &self.commanded, method)?;
        self.change.copy_from_slice(step.change);
        // The solution of de/dt = -gain e over this time: no overshoot, whatever the gain.
        let share = -libm::expm1(-servo.gain_per_s * moved_s);
        let joints = self.solver.arm().joints();
        let MotionLimits { velocity, declared_acceleration, .. } = self.limits;
        // An error that falls as exp(-gain t) decelerates by gain times the speed: a speed above acceleration / gain could not
        // be braked within the declared acceleration.
        let times_too_fast = |(joint, change): (&ArmJoint, &f64)| {
            let at = joint.coordinate;
            share * change.abs() / (velocity[at].min(declared_acceleration[at] / servo.gain_per_s) * moved_s)
        };
        // One factor for all joints keeps the direction of the tool.
        let slower = joints.iter().zip(&self.change).map(times_too_fast).fold(1.0, f64::max);
        for change in &mut self.change {
            *change = share * *change / slower;
        }
        // After the speed, since what remains of the change decides how much the speed changes in this step.
        let times_too_sudden = |(joint, change): (&ArmJoint, &f64)| {
            let at = joint.coordinate;
            (change - qd[at] * moved_s).abs() / (declared_acceleration[at] * moved_s * moved_s)
        };
        let later = joints.iter().zip(&self.change).map(times_too_sudden).fold(1.0, f64::max);
        self.before.copy_from_slice(q);
        for (joint, change) in joints.iter().zip(&self.change) {
            let (reference, keeps_on) = (&mut q[joint.coordinate], qd[joint.coordinate] * moved_s);
            let change = if later > 1.0 { keeps_on + (change - keeps_on) / later } else { *change };
            *reference = (*reference + change).clamp(joint.lower, joint.upper);
        }
        self.robot.apply_mimic(q);
        // From the positions, after clamping and mimic joints, so that velocity and position of the setpoint agree.
        for ((qd, q), before) in qd.iter_mut().zip(q.iter()).zip(&self.before) {
            // By the whole step, in which a motion that ends early is at rest until its end.
            *qd = (q - before) / step_s;
        }
        Ok(())
    }

    /// The result of a servo at the measured positions.
    pub(crate) fn result(
        &mut self,
        servo: &TcpServo,
        motion: usize,
        measured_q: &RobotQ,
        q: &RobotQ,
    ) -> Result<ServoResult, KinematicsError> {
        self.copy_arm(measured_q, q);
        let method = differential_method(servo.method);
        let step = self.solver.change_towards(&servo.target, &self.measured, &self.commanded, method)?;
        let (position_m, orientation_rad) = (step.residual_position_m, step.residual_orientation_rad);
        let held = step.limits_held.to_vec();
        let joints = self.solver.arm().joints();
        let name = |at: usize| self.robot.joint(joints[at].joint).name.clone();
        Ok(ServoResult {
            motion,
            method: servo.method,
            position_m,
            orientation_rad: (servo.target.part == TargetPart::Pose).then_some(orientation_rad),
            limits_held: held.into_iter().map(name).collect(),
        })
    }

    /// Copies the coordinates of the arm out of the robot's.
    fn copy_arm(&mut self, measured_q: &RobotQ, reference_q: &RobotQ) {
        for (at, joint) in self.solver.arm().joints().iter().enumerate() {
            self.measured[at] = measured_q[joint.coordinate];
            self.commanded[at] = reference_q[joint.coordinate];
        }
    }
}

impl std::fmt::Display for ServoResult {
    /// In words: `servo by pseudo_inverse, residual 1.2e-9 m`.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "servo by {}, residual {:.1e} m", self.method.word(), self.position_m)?;
        if let Some(orientation_rad) = self.orientation_rad {
            write!(f, " and {orientation_rad:.1e} rad")?;
        }
        if !self.limits_held.is_empty() {
            write!(f, ", joints at a limit: {}", self.limits_held.join(", "))?;
        }
        Ok(())
    }
}

/// The differential inverse kinematics of a servo's method.
fn differential_method(method: ServoMethod) -> DifferentialMethod {
    match method {
        ServoMethod::PseudoInverse => DifferentialMethod::PseudoInverse,
        ServoMethod::Transpose => DifferentialMethod::Transpose,
    }
}
