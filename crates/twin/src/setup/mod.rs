//! A scenario checked against its robot: nothing later validates again.

mod clock;
mod declared_dynamics;
mod joint_targets;
mod numbers;
mod payload;
mod run_setup;
mod spaces;
mod zones;

pub use clock::RunClock;
pub use declared_dynamics::DeclaredDynamics;
pub(crate) use joint_targets::JointTargets;
pub use payload::Payload;
pub use run_setup::RunSetup;
pub use zones::Zone;
