//! `[[motion]]` and `[limits]`: the motions of a scenario as data.

mod kinds;
mod limits;
mod paths;
mod profile;

pub(crate) use kinds::{
    ARC_KEY, JOINT_KEYS, JOINT_PATH_KEYS, LINE_KEY, PLAYBACK_KEY, SERVO_KEY, TCP_KEY, TCP_PATH_KEY,
};
pub use kinds::{JointMotion, MotionSettings, ServoMethod, ServoMotion, TcpMotion};
pub use limits::{LimitSettings, OverLimit};
pub use paths::{
    ArcMotion, ArcSettings, Between, JointPathMotion, LineMotion, PlaybackMotion, TcpPathMotion,
    ToolOrientation,
};
pub use profile::{Profile, Progress};
