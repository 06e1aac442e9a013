//! Checks of distances.

mod clearance;
mod contact;
mod judged_pairs;
mod nearest_that_changes;
mod unforced;
mod zone;

pub(super) use clearance::{ClearanceMonitor, examine_minimum, examine_pairs};
pub(super) use contact::ContactMonitor;
pub use judged_pairs::JudgedPairs;
pub(super) use zone::ZoneMonitor;
