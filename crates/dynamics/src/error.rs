//! Errors of the dynamics: vectors of a wrong length, and joints without inertia.

/// Why torques or accelerations cannot be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DynamicsError {
    /// A vector has another length than the robot has moving joints.
    #[error("{what}: {found} values for {expected} moving joints")]
    Length {
        /// Name of the vector, as in "positions".
        what: &'static str,
        /// The robot's degrees of freedom, mimic joints included.
        expected: usize,
        /// Length of the vector.
        found: usize,
    },
    /// A joint carries no inertia against its own motion, so that a torque has no finite acceleration.
    #[error(
        "joint \"{joint}\" moves no inertia: the links that it carries have no mass, or no inertia about its axis"
    )]
    NoInertia {
        /// Name of the joint.
        joint: String,
    },
}

impl DynamicsError {
    /// Checks the length of a vector once, so that the loops need no check of their own.
    pub(crate) fn check(what: &'static str, expected: usize, vector: &[f64]) -> Result<(), Self> {
        if vector.len() == expected {
            Ok(())
        } else {
            Err(Self::Length { what, expected, found: vector.len() })
        }
    }
}
