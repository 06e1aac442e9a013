//! Checks of distances.

mod clearance;
mod contact;
mod zone;

pub(super) use clearance::{ClearanceMonitor, examine_minimum, examine_pairs};
pub(super) use contact::ContactMonitor;
pub(super) use zone::ZoneMonitor;
