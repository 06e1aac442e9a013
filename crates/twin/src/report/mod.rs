//! What a run leaves behind for programs: `report.json` is the truth, `junit.xml` a view of it.

mod files;
mod junit;
mod run_report;

pub use files::{OutputError, OutputFolder, write_whole};
pub use junit::{sentence, write_junit};
pub use run_report::{LinkSource, RunClockReport, RunReport, Versions};
