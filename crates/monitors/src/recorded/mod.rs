//! Checks of what was recorded of a robot: its poses, its velocities, and how much of the log could be used.

mod effort;
mod pose;
mod recording;
mod same_point;
mod scatter;
mod step;
mod velocity;

pub(super) use effort::{RecordedEffortMonitor, UNEXPLAINED_SHARE};
pub(super) use pose::{PoseMonitor, default_limits};
pub(super) use recording::{RecordingMonitor, USED_SHARE};
pub(super) use same_point::{SPREAD_M, SamePointMonitor};
pub(super) use step::{StepMonitor, default_jumps};
pub(super) use velocity::{FACTOR, VelocityMonitor};
