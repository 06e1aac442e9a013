//! The setpoints of a trajectory, step after step.

use std::path::Path;

use congruent_description::{RobotDescription, RobotQ};
use congruent_input::{Diagnostic, FileAccess, Findings};
use congruent_kinematics::KinematicsError;
use congruent_scenario::{FilePlace, MotionSettings, ScenarioFolder};

use super::{
    motion_plan::{Motion, MotionPlan, PlannedMove, SetpointMut},
    planning::Planning,
    tcp::tcp_servo::{ServoController, ServoResult, StepInterval},
    trajectory::{Trajectory, plan},
};
use crate::codes;

/// Why a setpoint cannot be computed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MotionError {
    /// The measured positions do not have one value for each movable joint.
    #[error(transparent)]
    Kinematics(#[from] KinematicsError),
    /// A motion after a servo cannot be planned from the end of the servo.
    #[error("motion {motion}{} cannot be planned from the end of the servo_tcp before it: {}{}", at_line(*.line), .finding.message, help(.finding))]
    Planning {
        /// Number of the motion in the scenario, from 1.
        motion: usize,
        /// Line of the motion in the scenario file, if there is a file.
        line: Option<usize>,
        /// The error of planning.
        finding: Box<Diagnostic>,
    },
}

fn at_line(line: Option<usize>) -> String {
    line.map_or_else(String::new, |line| format!(" (line {line} of the scenario)"))
}

fn help(finding: &Diagnostic) -> String {
    finding.help.as_ref().map_or_else(String::new, |help| format!("; {help}"))
}

/// A motion that was planned in the run, after a servo, and takes longer than the scenario says.
#[derive(Debug, Clone, PartialEq)]
pub struct SlowedMotion {
    /// Index of the motion in the scenario, from 0.
    pub motion: usize,
    /// Additional duration; all motions after it, and the end of the run, are later by this.
    pub longer_s: f64,
    /// The warning that names the violated limit.
    pub warning: Diagnostic,
}

/// The setpoints of a run. Planned moves are evaluated at the time; servos are computed from the measured
/// positions at every step.
#[derive(Debug, Clone)]
pub struct ReferenceGenerator<'a> {
    trajectory: &'a Trajectory,
    description: &'a RobotDescription,
    /// The last move that was planned during the run.
    planned: Option<PlannedMove>,
    /// The controller of the servos; `None` if there are none.
    servo_controller: Option<ServoController<'a>>,
    /// The motion of the last step, and when it began.
    current: Option<(usize, f64)>,
    /// Motions that were planned in the run and made slower.
    slowed: Vec<SlowedMotion>,
    /// By how much the motions after the present one are later than in the trajectory.
    later_s: f64,
    /// Time of the present setpoint.
    time_s: f64,
    q: RobotQ,
    qd: Vec<f64>,
    qdd: Vec<f64>,
    servo_results: Vec<ServoResult>,
}

impl<'a> ReferenceGenerator<'a> {
    /// A generator at the start of a trajectory.
    ///
    /// # Errors
    /// [`KinematicsError::NoJoint`] if a servo has no joint to move; `RunSetup` refuses such scenarios.
    pub fn new(
        trajectory: &'a Trajectory,
        description: &'a RobotDescription,
    ) -> Result<Self, KinematicsError> {
        let servo_controller = trajectory
            .has_servo()
            .then(|| ServoController::new(description, &trajectory.limits))
            .transpose()?;
        Ok(Self::with(trajectory, description, servo_controller))
    }

    pub(super) fn with(
        trajectory: &'a Trajectory,
        description: &'a RobotDescription,
        servo_controller: Option<ServoController<'a>>,
    ) -> Self {
        let q = trajectory.start.clone();
        Self {
            trajectory,
            description,
            planned: None,
            servo_controller,
            current: None,
            slowed: Vec::new(),
            later_s: 0.0,
            time_s: 0.0,
            qd: vec![0.0; q.len()],
            qdd: vec![0.0; q.len()],
            q,
            servo_results: Vec::new(),
        }
    }

    /// The desired positions, rad or m, one entry for each movable joint.
    pub fn q(&self) -> &RobotQ {
        &self.q
    }

    /// The desired velocities, rad/s or m/s, likewise.
    pub fn qd(&self) -> &[f64] {
        &self.qd
    }

    /// The desired accelerations, rad/s^2 or m/s^2, likewise; 0 during a servo, which gives none.
    pub fn qdd(&self) -> &[f64] {
        &self.qdd
    }

    /// Computes the setpoint for `time_s`, which is later than the last; `measured_q` are the positions one step
    /// before.
    ///
    /// # Errors
    /// [`MotionError`] if `measured_q` is not a configuration of the robot, or a motion after a servo cannot be planned.
    pub fn advance(&mut self, time_s: f64, measured_q: &RobotQ) -> Result<(), MotionError> {
        let before_s = std::mem::replace(&mut self.time_s, time_s);
        // Before the first motion the arm holds its start.
        let Some((index, starts_s)) = self.under_way(time_s) else { return Ok(()) };
        // Once per motion: results of servos are stored, and an open motion is planned only when its start is known.
        if self.current.is_none_or(|(current, _)| current != index) {
            self.leave(measured_q)?;
            self.current = Some((index, starts_s));
            if let MotionPlan::Open(settings) = &self.trajectory.motions[index].motion_plan {
                self.planned = Some(self.plan(settings, index)?);
            }
        }
        let motion = &self.trajectory.motions[index];
        match &motion.motion_plan {
            MotionPlan::Planned(planned) => {
                planned.at(time_s - starts_s, setpoint(&mut self.q, &mut self.qd, &mut self.qdd));
            }
            MotionPlan::Open(_) => {
                // It was planned when the motion began.
                if let Some(planned) = &self.planned {
                    planned.at(time_s - starts_s, setpoint(&mut self.q, &mut self.qd, &mut self.qdd));
                }
            }
            MotionPlan::Servo(servo) => {
                self.qdd.fill(0.0);
                // The part of this step that lies within the motion.
                let [from_s, to_s] =
                    [before_s, time_s].map(|time_s| (time_s - starts_s).clamp(0.0, motion.duration_s));
                self.qdd.fill(0.0);
                let interval = StepInterval { step_s: time_s - before_s, moved_s: to_s - from_s };
                needed(&mut self.servo_controller).advance(
                    servo,
                    measured_q,
                    interval,
                    setpoint(&mut self.q, &mut self.qd, &mut self.qdd),
                )?;
            }
        }
        Ok(())
    }

    /// The results of the servos; of the current one at the present positions, unless these are not finite.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] if `measured_q` is not a configuration of the robot.
    pub fn finish(&mut self, measured_q: &RobotQ) -> Result<Vec<ServoResult>, KinematicsError> {
        // A simulation that has failed may have NaN here; a result of it would hide the error.
        if measured_q.iter().all(|q| q.is_finite()) {
            self.leave(measured_q)?;
        }
        Ok(std::mem::take(&mut self.servo_results))
    }

    /// The motions that were planned during the run and made slower.
    pub fn slowed(&self) -> &[SlowedMotion] {
        &self.slowed
    }

    /// The motion at a time with its start. A motion that was made slower is not left before its own, later end.
    fn under_way(&self, time_s: f64) -> Option<(usize, f64)> {
        // The plan's clock: it runs behind by what motions have taken longer.
        let planned = self.trajectory.under_way(time_s - self.later_s);
        let begun = planned.map(|(index, starts_s)| (index, starts_s + self.later_s));
        match (self.current, begun) {
            // Only forwards: `later_s` grows when a motion is slowed, and the plan's clock then goes back into the
            // motion before.
            (Some((current, _)), Some((index, _))) if index > current => begun,
            (None, _) => begun,
            (current, _) => current,
        }
    }

    /// Plans a motion from the setpoint at which the arm is held now, so that the setpoint does not jump.
    fn plan(&mut self, settings: &MotionSettings, index: usize) -> Result<PlannedMove, MotionError> {
        let mut warnings = Vec::new();
        // Motions after a servo name no file.
        let access = FileAccess::default();
        let mut planning = Planning {
            description: self.description,
            limits: &self.trajectory.limits,
            folder: ScenarioFolder { path: Path::new(""), access: &access },
            from: &self.q,
            place: FilePlace::nowhere(),
            warnings: &mut warnings,
        };
        let refused = |found: Findings| MotionError::Planning {
            motion: index + 1,
            line: self.trajectory.lines.get(index).copied().flatten(),
            finding: Box::new(found.into_first()),
        };
        let mut planned = plan(std::slice::from_ref(settings), 0, &mut planning).map_err(refused)?;
        let Motion { duration_s, motion_plan } = planned.swap_remove(0);
        let longer_s = duration_s - self.trajectory.motions[index].duration_s;
        // Rounding may change the duration without a warning; only a motion that was slowed shifts the others.
        if let Some(warning) = warnings.into_iter().find(|warning| warning.code == codes::scenario::SLOWED) {
            self.later_s += longer_s;
            self.slowed.push(SlowedMotion { motion: index, longer_s, warning });
        }
        match motion_plan {
            MotionPlan::Planned(planned) => Ok(planned),
            MotionPlan::Open(_) | MotionPlan::Servo(_) => unreachable!("an open motion is planned"),
        }
    }

    /// Ends the present motion: the setpoint is then exactly the end of a move, since a step may end after it; the result of
    /// a servo is stored.
    fn leave(&mut self, measured_q: &RobotQ) -> Result<(), KinematicsError> {
        let Some((index, _)) = self.current else { return Ok(()) };
        match &self.trajectory.motions[index].motion_plan {
            MotionPlan::Planned(planned) => self.q.copy_from_slice(&planned.to),
            MotionPlan::Open(_) => {
                if let Some(planned) = &self.planned {
                    self.q.copy_from_slice(&planned.to);
                }
            }
            MotionPlan::Servo(servo) => {
                self.servo_results.push(needed(&mut self.servo_controller).result(
                    servo,
                    index + 1,
                    measured_q,
                    &self.q,
                )?);
            }
        }
        Ok(())
    }
}

fn needed<'d, 'a>(servo_controller: &'d mut Option<ServoController<'a>>) -> &'d mut ServoController<'a> {
    servo_controller.as_mut().expect("a trajectory with a servo has a servo controller")
}

fn setpoint<'s>(q: &'s mut RobotQ, qd: &'s mut [f64], qdd: &'s mut [f64]) -> SetpointMut<'s> {
    SetpointMut { q, qd, qdd }
}
