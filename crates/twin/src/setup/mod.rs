//! A scenario checked against its robot: nothing later validates again.

mod bodies;
mod clock;
mod joint_targets;
mod motion_limits;
mod numbers;
mod payload;
mod run_setup;
mod spaces;
mod written_out;
mod zones;

pub use clock::RunClock;
pub(crate) use joint_targets::JointTargets;
pub use payload::Payload;
pub use run_setup::RunSetup;
pub use zones::Zone;
