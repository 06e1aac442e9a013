//! How a planned move proceeds over time, and the limits that its joints must keep.

mod limits;
mod pace;
mod speed_profile;

pub use limits::MotionLimits;
pub use pace::Pace;
pub(super) use pace::least_time;
pub use speed_profile::{RateLimits, SpeedProfile, Stretch};
