//! Sources of joint states: a simulation, later a log or a live robot.

use congruent_monitors::{ContactForce, JointSample, StepForces};
use congruent_motion::{ServoResult, SlowedMotion};
use nalgebra::Isometry3;

use super::actuators::ActuatorUse;

/// A source of joint states: sample after sample, each later than the one before.
pub trait JointStateSource {
    /// The joints at the present instant.
    fn joints(&self) -> JointSample<'_>;

    /// Number of steps since the source began.
    fn step_count(&self) -> u64;

    /// Writes the poses of all links at the present instant, in the root link's frame and the robot's order,
    /// and returns whether the source knows them: a log of joint states does not, and the poses are then those
    /// of the URDF chain at the true joint positions.
    fn root_from_links_into(&self, root_from_links: &mut [Isometry3<f64>]) -> bool;

    /// Advances to the next sample, which is at `time_s`.
    ///
    /// # Errors
    /// [`SourceError`] if there is no usable sample.
    fn advance(&mut self, time_s: f64) -> Result<(), SourceError>;

    /// How far actuators were used so far, for a source that has them.
    fn actuators(&self) -> Vec<ActuatorUse> {
        Vec::new()
    }

    /// The forces in the step that led to the present instant; only a simulation knows them.
    fn step_forces(&self) -> StepForces {
        StepForces::Unknown
    }

    /// The links and obstacles that pushed each other in that step; only a simulation knows them.
    fn contact_forces(&self) -> &[ContactForce] {
        &[]
    }

    /// Brings the robot to rest from the present instant on, within its limits: the setpoint slows down and stays. Returns
    /// whether the source can do so; one that drives nothing cannot.
    fn begin_stop(&mut self) -> bool {
        false
    }

    /// In a stop, for each movable joint the speed that its setpoint lost at once at the end of the joint's range, rad/s or m/s;
    /// `None` for one that slows down within its acceleration. Empty without a stop.
    fn stopped_at_end_of_range(&self) -> &[Option<f64>] {
        &[]
    }

    /// Motions that were planned in the run and take longer than the scenario says: the run is as much longer.
    fn slowed(&self) -> &[SlowedMotion] {
        &[]
    }

    /// The results of the servos, for a source that drives the robot.
    ///
    /// # Errors
    /// [`SourceError`] if they cannot be computed.
    fn finish(&mut self) -> Result<Vec<ServoResult>, SourceError> {
        Ok(Vec::new())
    }
}

/// By how much the motions end later than planned.
pub(crate) fn longer_s(source: &dyn JointStateSource) -> f64 {
    source.slowed().iter().map(|slowed| slowed.longer_s).sum()
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
