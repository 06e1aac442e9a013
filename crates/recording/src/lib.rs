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
    Basis, CheckSummary, Disagreement, EntitySummary, InspectError, QuantitySummary, Recheck, RecheckError,
    RecheckedCheck, RecheckedQuantity, RecordingSummary, ScalarSummary, TimelineSummary, inspect, label,
    recheck, scalars, scalars_csv,
};
pub use recorder::{RerunFormat, RerunRecorder};

/// The version of rerun that reads these recordings; a newer viewer reads them, too.
pub const RERUN_VERSION: &str = "0.36.3";
