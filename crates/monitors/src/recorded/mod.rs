//! Checks of what was recorded of a robot: its poses, its velocities, and how much of the log could be used.

mod pose;
mod recording;
mod scatter;
mod step;
mod velocity;

pub(super) use pose::{PoseMonitor, default_limits};
pub(super) use recording::{RecordingMonitor, USED_SHARE};
pub(super) use step::{StepMonitor, default_jumps};
pub(super) use velocity::{FACTOR, VelocityMonitor};
