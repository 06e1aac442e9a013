//! What a finished run has found, and why a run breaks.

use congruent_description::Robot;
use congruent_kinematics::KinematicsError;
use congruent_monitors::RecordingError;
use congruent_monitors::verdict::{CheckResult, RunStop, StopAcceleration, StopLimit};
use congruent_motion::{ServoResult, SlowedMotion};
use congruent_proximity::ProximityError;

use crate::source::{ActuatorUse, SourceError, stop_accelerations};

/// Why a run cannot start or cannot continue.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RunError {
    /// The source of joint states cannot start, or failed during the run.
    #[error(transparent)]
    Source(#[from] SourceError),
    /// The model does not fit the robot.
    #[error(transparent)]
    Kinematics(#[from] KinematicsError),
    /// A collision shape has no convex hull.
    #[error(transparent)]
    Proximity(#[from] ProximityError),
    /// The recording cannot be written.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// Somebody has ended the run.
    #[error("interrupted")]
    Interrupted,
}

/// What a finished run has found.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// Results of all checks, in the order of the scenario.
    pub checks: Vec<CheckResult>,
    /// Number of steps that were taken.
    pub steps: u64,
    /// Time from the first sample to the last one.
    pub duration_s: f64,
    /// The check that ended the run early, and when; `None` if none did.
    pub stopped: Option<RunStop>,
    /// The result of each servo: its error at the end.
    pub servos: Vec<ServoResult>,
    /// Motions that were planned in the run and take longer than the scenario says.
    pub slowed: Vec<SlowedMotion>,
    /// The use of each joint's actuator, if the source has actuators.
    pub actuators: Vec<ActuatorUse>,
    /// SHA-256 over the true joint positions of every sample.
    pub trajectory_sha256: String,
}

/// How each joint was slowed down in a stop.
pub(crate) fn braked(robot: &Robot, declared: &[f64], lost: &[Option<f64>]) -> Vec<StopAcceleration> {
    let limits = stop_accelerations(robot, declared).into_iter().zip(robot.movable_joint_names());
    let one = |(at, ((limit, source), joint)): (usize, ((f64, StopLimit), &str))| StopAcceleration {
        joint: joint.to_owned(),
        limit,
        source,
        lost_at_end_of_range: lost.get(at).copied().flatten(),
    };
    limits.enumerate().map(one).collect()
}

/// Bytes as digits.
pub(crate) fn hex(bytes: &[u8]) -> String {
    use std::fmt::Write;
    bytes.iter().fold(String::new(), |mut text, byte| {
        write!(text, "{byte:02x}").expect("a String takes every byte");
        text
    })
}
