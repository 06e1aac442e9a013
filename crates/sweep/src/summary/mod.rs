//! What the rows of a sweep show: verdicts, the range of each quantity, which value decides it, and the worst cases.

mod importance;
mod sweep_summary;

pub use importance::importance;
pub(crate) use sweep_summary::importances;
pub use sweep_summary::{MeasureSummary, SmallestMargin, SweepSummary};
