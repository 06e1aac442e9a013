//! The page of a check of robots: table, URDF and physics against each other.

mod certificate;
mod checked_robot;
mod comparisons;
mod dynamics;
mod page;

pub use checked_robot::CheckedRobot;
pub use page::{CheckEntry, check_page};
