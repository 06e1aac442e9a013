//! Cases of a plan, run one after another or on threads.

mod case_row;
mod ends;
mod runner;
mod threads;

pub use case_row::{CaseRow, CaseVerdict, WorstValue};
pub(crate) use case_row::{OF_CHANGING_PAIRS, check_names, measure_name};
pub use runner::CaseRunner;
pub use threads::run_cases;
