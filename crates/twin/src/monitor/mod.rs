//! Checks of a scenario in a run: each gets every sample.

mod agreement;
mod clearance;
mod goal;
mod limits;
#[expect(clippy::module_inception, reason = "the trait of this module")]
mod monitor;
mod names;
mod running_check;
mod watch;
mod zone;

pub(crate) use limits::{ANGLE_BEYOND_LIMIT, AT_THE_LIMIT, SHIFT_BEYOND_LIMIT};
pub use monitor::{Monitor, Observed};
pub use names::Names;
pub use running_check::RunningCheck;
