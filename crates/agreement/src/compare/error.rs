//! Why sources of link poses cannot be compared.

use congruent_kinematics::{KinematicsError, LinkPosesError};

/// Why two sources cannot be compared.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CheckError {
    /// A source of link poses rejects a configuration.
    #[error(transparent)]
    Source(#[from] LinkPosesError),
    /// The model does not fit the robot.
    #[error(transparent)]
    Kinematics(#[from] KinematicsError),
}
