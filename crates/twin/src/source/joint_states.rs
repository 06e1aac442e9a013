//! Where joint states come from: a simulation, later a log or a live robot.

use congruent_description::RobotQ;
use nalgebra::Isometry3;

use crate::motion::ServoResult;

/// Positions, velocities and efforts of all movable joints of a robot at one instant.
#[derive(Debug, Clone, Copy)]
pub struct JointStateView<'a> {
    /// Positions.
    pub q: &'a RobotQ,
    /// Velocities, rad/s or m/s; empty if the source has none.
    pub qd: &'a [f64],
    /// Efforts, N m or N; empty if the source has none.
    pub effort: &'a [f64],
}

/// What was asked of the joints.
#[derive(Debug, Clone, Copy)]
pub struct SetpointView<'a> {
    /// Positions.
    pub q: &'a RobotQ,
    /// Velocities, rad/s or m/s.
    pub qd: &'a [f64],
}

/// The joints of a robot at one instant.
#[derive(Debug, Clone, Copy)]
pub struct JointSample<'a> {
    /// As they are. A source that cannot know it gives what is measured.
    pub truth: JointStateView<'a>,
    /// As the robot's sensors say: an encoder's fault stands between the two.
    pub measured: JointStateView<'a>,
    /// What was commanded; `None` if the source does not know.
    pub setpoint: Option<SetpointView<'a>>,
}

/// A source of joint states: sample after sample, each later than the one before.
pub trait JointStateSource {
    /// The joints at the present instant.
    fn joints(&self) -> JointSample<'_>;

    /// Number of steps since the source began.
    fn step_count(&self) -> u64;

    /// Writes the poses of all links at the present instant, in the root link's frame and the robot's order,
    /// and says whether the source sees them: a log of joint states does not, and the links are then placed
    /// by the URDF chain at the true joint positions.
    fn root_from_links_into(&self, root_from_links: &mut [Isometry3<f64>]) -> bool;

    /// Goes on to the next sample, which is at `time_s`.
    ///
    /// # Errors
    /// [`SourceError`] if there is none that could be used.
    fn advance(&mut self, time_s: f64) -> Result<(), SourceError>;

    /// How far servos have brought the tool, for a source that drives the robot.
    ///
    /// # Errors
    /// [`SourceError`] if that cannot be told.
    fn finish(&mut self) -> Result<Vec<ServoResult>, SourceError> {
        Ok(Vec::new())
    }
}

/// Why a source has no further sample.
#[derive(Debug, thiserror::Error)]
#[error(transparent)]
pub struct SourceError(Box<dyn std::error::Error + Send + Sync>);

impl SourceError {
    /// What a source says.
    pub fn new(error: impl std::error::Error + Send + Sync + 'static) -> Self {
        Self(Box::new(error))
    }
}
