//! How far two chains can be apart over the whole joint range: attained from below, bounded from above.

mod branch;
mod budget;
mod certify;
mod common_order;
mod corner;
mod difference_norm;
mod intermediate_chains;
mod search;
mod simplify;
mod telescoping;

pub use budget::Budget;
pub use certify::{Bracket, Certificate, certify, certify_driven};
