//! Values in which two descriptions differ: invariants, parameters (with or without an effect on torques), limits.

pub(crate) mod hidden;
pub(crate) mod invariants;
pub(crate) mod limits;
pub(crate) mod parameters;

pub use invariants::{CandidateAndReference, Invariants};
pub use limits::{LimitCause, LimitDifference};
pub use parameters::ParameterDifference;
