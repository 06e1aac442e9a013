//! Sources of joint states: a simulation, a log or a live robot.

use congruent_description::RobotQ;
use congruent_monitors::{ContactForce, JointSample, LeftOutInstants, StepForces};
use congruent_motion::{ServoResult, SlowedMotion};
use nalgebra::Isometry3;

use super::actuators::ActuatorUse;

/// What follows the present instant of a source.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Advance {
    /// The next sample, at this time, s.
    At(f64),
    /// The source has nothing between two times. The sample that ends the gap follows with the next call.
    Gap {
        /// Time of the sample before the gap.
        from_s: f64,
        /// Time of the sample after it.
        to_s: f64,
    },
    /// No sample follows.
    End,
}

/// A pose that a source has of the robot, at its own instant.
#[derive(Debug, Clone, Copy)]
pub struct SourcePose<'a> {
    /// Number of the poses in the setup.
    pub of: usize,
    /// Its instant, s.
    pub time_s: f64,
    /// The pose of the target in its frame.
    pub frame_from_target: Isometry3<f64>,
    /// The joint positions at that instant, rad or m.
    pub q: &'a RobotQ,
}

/// A source of joint states: sample after sample, each later than the one before. The time is the source's.
pub trait JointStateSource {
    /// Time of the first sample, s.
    fn start_s(&self) -> f64 {
        0.0
    }

    /// The joints at the present instant.
    fn joints(&self) -> JointSample<'_>;

    /// Writes the poses of all links at the present instant, in the root link's frame and the robot's order,
    /// and returns whether the source knows them: a log of joint states does not, and the poses are then those
    /// of the URDF chain at the joint positions.
    fn root_from_links_into(&self, _root_from_links: &mut [Isometry3<f64>]) -> bool {
        false
    }

    /// Advances to the next sample. A source that can choose its instant takes `wanted_s`, which is one step of the run
    /// after the sample before; a log has the time that was recorded.
    ///
    /// # Errors
    /// [`SourceError`] if there is no usable sample.
    fn advance(&mut self, wanted_s: f64) -> Result<Advance, SourceError>;

    /// Whether it is known already that no sample follows. What is judged at the end of a run is judged at this sample; the
    /// end of a source that does not know it before is found by [`Advance::End`], and judges nothing.
    fn is_last(&self) -> bool;

    /// Instants that the source has left out since the sample before.
    fn left_out(&self) -> LeftOutInstants {
        LeftOutInstants::default()
    }

    /// Instants that the source has left out after the present sample, if no sample follows.
    fn left_out_after(&self) -> LeftOutInstants {
        LeftOutInstants::default()
    }

    /// Whether the present sample begins another part of what was recorded: its time from the sample before means nothing.
    fn begins_part(&self) -> bool {
        false
    }

    /// The next pose that the source has of the robot, up to the present instant; `None` after the last.
    fn next_pose(&mut self) -> Option<SourcePose<'_>> {
        None
    }

    /// What only a simulation knows and can do; `None` for states that were recorded or arrive.
    fn simulated(&self) -> Option<&dyn SimulatedRobot> {
        None
    }

    /// The same, to change it.
    fn simulated_mut(&mut self) -> Option<&mut dyn SimulatedRobot> {
        None
    }
}

/// What only a simulation knows of its robot, and can do with it.
pub trait SimulatedRobot {
    /// The forces in the step that led to the present instant.
    fn step_forces(&self) -> StepForces;

    /// The links and obstacles that pushed each other in that step.
    fn contact_forces(&self) -> &[ContactForce];

    /// Motions that were planned in the run and take longer than the scenario says: the run is as much longer.
    fn slowed(&self) -> &[SlowedMotion];

    /// How far actuators were used so far, if the robot has them.
    fn actuators(&self) -> Vec<ActuatorUse> {
        Vec::new()
    }

    /// Brings the robot to rest from the present instant on, within its limits: the setpoint slows down and stays. Returns
    /// whether it can.
    fn begin_stop(&mut self) -> bool {
        false
    }

    /// In a stop, for each movable joint the speed that its setpoint lost at once at the end of the joint's range, rad/s or m/s;
    /// `None` for one that slows down within its acceleration. Empty without a stop.
    fn stopped_at_end_of_range(&self) -> &[Option<f64>] {
        &[]
    }

    /// The results of the servos.
    ///
    /// # Errors
    /// [`SourceError`] if they cannot be computed.
    fn finish(&mut self) -> Result<Vec<ServoResult>, SourceError> {
        Ok(Vec::new())
    }
}

/// By how much the motions end later than planned.
pub(crate) fn longer_s(slowed: &[SlowedMotion]) -> f64 {
    slowed.iter().map(|slowed| slowed.longer_s).sum()
}

/// Why a source has no further sample.
#[derive(Debug, thiserror::Error)]
#[error(transparent)]
pub struct SourceError(Box<dyn std::error::Error + Send + Sync>);

impl SourceError {
    /// Wraps the error of a source.
    pub fn new(error: impl std::error::Error + Send + Sync + 'static) -> Self {
        Self(Box::new(error))
    }
}
