//! Recordings of runs for the rerun viewer: the twin, the model and their disagreement over time, and a
//! summary of any recording. The only crate that names rerun's crates. A recording shows a run; no report
//! needs a value from it.
//!
//! Equal runs give equal bytes: no wall clock, counted identifiers, a sorted footer.

mod blueprint;
mod outcome;
mod read;
mod recorder;
mod rrd;
mod scene;
mod series;

pub use read::{
    EntitySummary, InspectError, RecordingSummary, ScalarSummary, TimelineSummary, inspect, scalars,
};
pub use recorder::{RerunFormat, RerunRecorder};
