//! One scenario with many values: the cases of a plan, run in this process, a row each.
//!
//! [`plan`] says what varies, and gives each case its values by its number alone, so that a sweep can be cut anywhere;
//! [`run`] runs cases on threads, [`store`] keeps their rows and merges them, [`summary`] says what they show.

pub mod codes;
pub mod plan;
pub mod run;
mod sampling;
pub mod store;
pub mod summary;
mod uncertain_cases;

pub use congruent_scenario::CaseSampling;
pub use uncertain_cases::{CaseThreads, UncertainCases};
