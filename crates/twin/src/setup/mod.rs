//! A scenario checked against its robot: nothing later validates again.

pub(crate) mod actuation;
mod checks;
mod clock;
mod cost;
mod declared_dynamics;
mod joint_targets;
mod motion_limits;
mod numbers;
mod output;
mod payload;
mod run_setup;
mod surroundings;
mod written_out;

pub(crate) use actuation::{ActuatorLimits, Sampling};
pub use actuation::{ControllerSetup, SensorSetup, TorqueTable};
pub use clock::RunClock;
pub use declared_dynamics::DeclaredDynamics;
pub(crate) use joint_targets::{JointTargets, moving_joint};
pub use payload::Payload;
pub use run_setup::RunSetup;
pub(crate) use surroundings::LARGEST_M;
pub use surroundings::Zone;
