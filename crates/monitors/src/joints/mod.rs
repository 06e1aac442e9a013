//! Checks of the joints' motion.

mod cycle_time;
mod limits;
mod tracking;
mod travel;

pub(super) use cycle_time::{AT_THE_END, CycleTimeMonitor};
pub(super) use limits::{
    AT_THE_LIMIT, LARGEST_EFFORT_SHARE, LARGEST_VELOCITY_SHARE, LimitsMonitor, examine as examine_limits,
};
pub(super) use tracking::{TrackingMonitor, examine as examine_tracking};
