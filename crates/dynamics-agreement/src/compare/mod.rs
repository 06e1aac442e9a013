//! Two descriptions against each other: invariants, figures that no torque shows, limits.

pub(crate) mod figures;
pub(crate) mod hidden;
pub(crate) mod invariants;
pub(crate) mod limits;

pub use figures::FigureDifference;
pub use invariants::{Compared, Invariants};
pub use limits::{LimitCause, LimitDifference};
