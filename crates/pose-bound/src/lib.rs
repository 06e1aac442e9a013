//! How far two chains of screws can be apart over the whole joint range: the largest difference that a
//! configuration attains, and a bound that no configuration exceeds.
//!
//! `docs/bound.md` derives the bound and says which file does which step.

mod branch;
mod budget;
mod certify;
mod common_order;
mod corner;
mod difference_norm;
mod intermediate_chains;
mod joint_sweep;
mod reach;
mod search;
mod simplify;
mod telescoping;

pub use budget::Budget;
pub use certify::{Bracket, Certificate, certify, certify_driven};
pub use common_order::DrivenScrews;
