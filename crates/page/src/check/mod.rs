//! The page of a check of robots: table, URDF and physics against each other.

mod certificate;
mod comparisons;
mod dynamics;
mod page;

pub use page::{CheckEntry, CheckedRobot, check_page};
