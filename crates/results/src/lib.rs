//! The results of a run: its report for people and for CI, tables of what happened, and the comparison of two runs.
//!
//! [`execute()`] runs one scenario and writes its results.

pub mod comparison;
mod execute;
pub mod files;
pub mod report;
pub mod trajectory_file;

pub use execute::{
    ExecuteError, IfIncomplete, Options, RecordedRun, Recording, RecordingFormat, execute, execute_with,
    finished, missing_files, record,
};
