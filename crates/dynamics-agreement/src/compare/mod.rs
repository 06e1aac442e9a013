//! Two descriptions against each other: invariants, parameters that no torque shows, limits.

pub(crate) mod hidden;
pub(crate) mod invariants;
pub(crate) mod limits;
pub(crate) mod parameters;

pub use invariants::{Compared, Invariants};
pub use limits::{LimitCause, LimitDifference};
pub use parameters::ParameterDifference;
