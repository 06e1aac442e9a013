//! Results of a run for programs: `report.json` has everything, `junit.xml` the checks in the format of CI.

mod causes;
mod fault_table;
mod files;
mod junit;
mod run_report;
mod sentence;
mod test_suite;

pub(crate) use causes::explain;
pub use fault_table::{FaultRow, FaultTable, SeenBy};
pub use files::{OutputError, OutputFolder, write_whole};
pub use junit::{Clock, Reason, TestCase, TestResult, TestSuite, write_junit};
pub use run_report::{LinkSource, MotionTimes, RunClockReport, RunReport, Versions};
pub use sentence::{limit_words, lines, margin_words, quantity_words, sentence_at};
