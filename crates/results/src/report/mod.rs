//! Results of a run for programs: `report.json` has everything, `junit.xml`, annotations and the summary the checks in the
//! formats of CI.

mod annotations;
mod causes;
mod earlier;
mod fault_table;
mod junit;
mod run_report;
mod sentence;
mod step_summary;
mod suite;
mod test_suite;

pub use annotations::github_annotations;
pub use causes::{Causes, diagnose_run, explain};
pub use earlier::earlier_report;
pub use fault_table::{DetectedBy, FaultRow, FaultTable};
pub use junit::write_junit;
pub use run_report::{LinkSource, MotionTimes, RunClockReport, RunReport, Versions};
pub use sentence::{
    failing, limit_words, lines, margin_words, quantity_words, sentence_at, share_in_full, worst_moment,
};
pub use step_summary::step_summary;
pub use suite::{CasePlace, Clock, Reason, TestCase, TestResult, TestSuite};
pub use test_suite::{judged, planned_suite, recorded_suite};
