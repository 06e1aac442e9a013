//! What a caller of the dynamics can get wrong, and robots that have no answer.

/// Why there is no result.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DynamicsError {
    /// A vector has another length than the robot has moving joints.
    #[error("{what}: {found} values for {expected} moving joints")]
    Length {
        /// Which vector.
        what: &'static str,
        /// The robot's degrees of freedom, mimic joints included.
        expected: usize,
        /// Length of the vector.
        found: usize,
    },
    /// A joint carries no inertia against its own motion: no acceleration belongs to a torque.
    #[error("joint \"{joint}\" moves no inertia: what it carries has no mass, or none about its axis")]
    NoInertia {
        /// The joint.
        joint: String,
    },
}

impl DynamicsError {
    /// Compares a length once, so that the loops behind need no further care.
    pub(crate) fn check(what: &'static str, expected: usize, vector: &[f64]) -> Result<(), Self> {
        if vector.len() == expected {
            Ok(())
        } else {
            Err(Self::Length { what, expected, found: vector.len() })
        }
    }
}
