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
    /// A requested position is so large that its digits do not resolve the tolerance.
    #[error(
        "configuration {number}: joint \"{joint}\" is at {}, where neighbouring floating-point numbers are {} apart, \
         more than the tolerance of {}; give the position within one turn, or a larger tolerance", what[0], what[1], what[2]
    )]
    Unresolved {
        /// Number of the configuration, from 1.
        number: usize,
        /// Name of the joint at that position.
        joint: String,
        /// Its position, the distance to the next number, and the tolerance, with their units.
        what: [String; 3],
    },
    /// The robot file declares joints of the other description that it does not have.
    #[error("{0}")]
    Mapping(String),
}
