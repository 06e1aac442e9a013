//! Cases of a plan, run one after another or on threads.

mod case_row;
mod ends;
mod runner;
mod threads;
mod uncertainty;

pub use case_row::{CaseRow, CaseVerdict, WorstValue};
pub use runner::CaseRunner;
pub use threads::run_cases;
pub use uncertainty::CaseThreads;
