//! Joint torques of two models at random states, and the effect of each parameter on their difference.

pub(crate) mod held_out;
pub(crate) mod least_squares;
pub(crate) mod reduced_difference;
pub(crate) mod source;
pub(crate) mod states;

pub use reduced_difference::IdentifiableParameters;
pub use source::{AccelerationSource, IdentificationOptions};
