//! How far two chains can be apart over the whole joint range: attained from below, bounded from above.

mod branch;
mod budget;
mod certify;
mod corner;
mod gap;
mod order;
mod reduce;
mod search;
mod telescope;
mod way;

pub use budget::Budget;
pub use certify::{Bracket, Certificate, certify, certify_driven};
