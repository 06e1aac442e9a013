//! Time scaling of planned moves, and the limits that their joints must keep.

mod limits;
mod speed_profile;
mod time_scaling;

pub use limits::MotionLimits;
pub use speed_profile::{RateLimits, SpeedProfile, Stretch};
pub use time_scaling::TimeScaling;
pub(super) use time_scaling::least_time;
