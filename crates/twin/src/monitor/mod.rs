//! Checks of a scenario in a run: each gets every sample.

mod context;
mod forces;
mod joints;
#[expect(clippy::module_inception, reason = "the trait of this module")]
mod monitor;
mod names;
mod pose;
mod running_check;
mod space;
mod watch;

pub use context::CheckContext;
pub(crate) use joints::{ANGLE_BEYOND_LIMIT, SHIFT_BEYOND_LIMIT};
pub use monitor::{Monitor, Observed};
pub use names::Names;
pub use running_check::RunningCheck;
pub(crate) use running_check::write_out_limits;
