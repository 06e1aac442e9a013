//! What a diagnosis says in names, lines and values of the robot file.

mod content;
mod diagnose_models;
mod fault_message;
mod names;
mod tell;
mod units;
mod values;

pub use content::{Fault, ReportedAlternative, ReportedCause, ReportedDiagnosis, ReportedDifference};
pub use diagnose_models::diagnose_models;
pub use values::ReportedValue;
