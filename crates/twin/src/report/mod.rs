//! Results of a run for programs: `report.json` has everything, `junit.xml` the checks in the format of CI.

mod files;
mod junit;
mod run_report;

pub use files::{OutputError, OutputFolder, write_whole};
pub use junit::{sentence, write_junit};
pub use run_report::{LinkSource, RunClockReport, RunReport, Versions};
