//! Why sources of link poses cannot be held against each other.

use congruent_kinematics::{KinematicsError, LinkPosesError};

/// Why two sources cannot be held against each other.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CheckError {
    /// A source of link poses refuses a configuration.
    #[error(transparent)]
    Source(#[from] LinkPosesError),
    /// The model does not fit the robot.
    #[error(transparent)]
    Kinematics(#[from] KinematicsError),
}
