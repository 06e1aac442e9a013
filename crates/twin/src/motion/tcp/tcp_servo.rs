//! `servo_tcp`: the tool centre point is driven to a pose, or to a position, by differential inverse
//! kinematics in the loop: at every step of the simulation the error and the Jacobian are those of
//! the measured joint positions. There is no plan, so the end is known only in the run.
//!
//! The loop adjusts the setpoint of the joints' controller. It integrates the changes that the error asks for
//! and does not start from the measured positions, so that an arm that sags under its controller reaches the
//! target all the same. For the same reason the setpoint goes on, up to the joint limits, if an obstacle stops
//! the arm: checks detect that, the servo does not.

use congruent_description::{ArmQ, Diagnostic, Elementary as _, Robot, RobotDescription, RobotQ};
use congruent_kinematics::{Arm, ArmJoint, DifferentialMethod, IkSolver, KinematicsError, TargetPart};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::tcp_move;
use crate::{
    motion::{
        course::{Course, Motion, TcpServo},
        planning::Planning,
        timing::MotionLimits,
    },
    scenario::{ServoMethod, ServoMotion},
};

/// Without a gain, an error falls to 1/e in 0.2 s.
pub(crate) const DEFAULT_GAIN_PER_S: f64 = 5.0;

/// The result of a servo.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ServoResult {
    /// Number of the motion in the scenario, from 1.
    pub motion: usize,
    /// Method by which joint velocities were computed from the error.
    pub method: ServoMethod,
    /// Remaining distance to the target.
    pub position_m: f64,
    /// Remaining angle; `None` if the target has no orientation.
    pub orientation_rad: Option<f64>,
    /// Joints that a position limit stops.
    pub limits_held: Vec<String>,
}

pub(in crate::motion) fn plan(settings: &ServoMotion, planning: &Planning<'_>) -> Result<Motion, Diagnostic> {
    let place = planning.place.key("servo_tcp");
    let (_, target) = tcp_move::target((&settings.servo_tcp, place), planning)?;
    let servo = TcpServo {
        target,
        method: settings.method,
        gain_per_s: settings.gain_per_s.unwrap_or(DEFAULT_GAIN_PER_S),
    };
    Ok(Motion { duration_s: settings.duration_s, course: Course::Servo(Box::new(servo)) })
}

/// Computes the steps of a servo without allocation.
#[derive(Debug, Clone)]
pub(in crate::motion) struct ServoController<'a> {
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
pub(in crate::motion) struct StepInterval {
    pub(in crate::motion) step_s: f64,
    pub(in crate::motion) moved_s: f64,
}

impl<'a> ServoController<'a> {
    /// Speeds and declared accelerations keep the limits.
    pub(in crate::motion) fn new(
        description: &'a RobotDescription,
        limits: &'a MotionLimits,
    ) -> Result<Self, KinematicsError> {
        let arm = Arm::of(description)?;
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

    /// Moves the setpoint `q` by one step towards the target, within the position limits of the joints; if a
    /// velocity limit is exceeded, all joints are scaled down alike; so is the change of their speeds if it exceeds a declared
    /// acceleration. `qd` is the mean over the step; before, over the one before.
    pub(in crate::motion) fn advance(
        &mut self,
        servo: &TcpServo,
        measured_q: &RobotQ,
        StepInterval { step_s, moved_s }: StepInterval,
        (q, qd): (&mut RobotQ, &mut [f64]),
    ) -> Result<(), KinematicsError> {
        if moved_s <= 0.0 {
            qd.fill(0.0);
            return Ok(());
        }
        self.copy_arm(measured_q, q);
        let (arm_q, method) = ((&self.measured, &self.commanded), servo.method.into());
        self.change.copy_from_slice(self.solver.change_towards(&servo.target, arm_q, method)?.change);
        // The solution of de/dt = -gain e over this time: no overshoot, whatever the gain.
        let share = -(-servo.gain_per_s * moved_s).exponential_less_one();
        let joints = self.solver.arm().joints();
        let MotionLimits { velocity, declared_acceleration, .. } = self.limits;
        // An error that falls as exp(-gain t) slows down by gain times the speed.
        let times_too_fast = |(joint, change): (&ArmJoint, &f64)| {
            let at = joint.coordinate;
            share * change.abs() / (velocity[at].min(declared_acceleration[at] / servo.gain_per_s) * moved_s)
        };
        let slower = joints.iter().zip(&self.change).map(times_too_fast).fold(1.0, f64::max);
        for change in &mut self.change {
            *change = share * *change / slower;
        }
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
        for ((qd, q), before) in qd.iter_mut().zip(q.iter()).zip(&self.before) {
            *qd = (q - before) / step_s;
        }
        Ok(())
    }

    /// The result of a servo at the present positions.
    pub(in crate::motion) fn result(
        &mut self,
        servo: &TcpServo,
        motion: usize,
        measured_q: &RobotQ,
        q: &RobotQ,
    ) -> Result<ServoResult, KinematicsError> {
        self.copy_arm(measured_q, q);
        let (arm_q, method) = ((&self.measured, &self.commanded), servo.method.into());
        let step = self.solver.change_towards(&servo.target, arm_q, method)?;
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
            write!(f, ", held by limits of {}", self.limits_held.join(", "))?;
        }
        Ok(())
    }
}

impl From<ServoMethod> for DifferentialMethod {
    fn from(method: ServoMethod) -> Self {
        match method {
            ServoMethod::PseudoInverse => Self::PseudoInverse,
            ServoMethod::Transpose => Self::Transpose,
        }
    }
}
