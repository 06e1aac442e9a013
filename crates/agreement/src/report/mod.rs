//! A diagnosis in names, lines and values of the robot file.

mod content;
mod describe;
mod diagnose_models;
mod fault_message;
mod names;
mod statement;
mod units;
mod values;

pub use content::{Fault, ReportedAlternative, ReportedCause, ReportedDiagnosis, ReportedDifference};
pub use diagnose_models::diagnose_models;
pub use statement::foremost;
pub use values::ReportedValue;
