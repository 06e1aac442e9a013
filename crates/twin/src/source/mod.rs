//! Sources of link poses, of dynamics and of joint states. A run takes any source of joint states.

mod actuators;
mod ahead;
mod braking;
mod carried;
mod friction_at_rest;
mod joint_states;
mod recorded;
mod run_source;
mod sensors;
mod simulated_dynamics;
mod simulated_poses;
mod simulation;
mod stream_progress;

pub use actuators::ActuatorUse;
pub(crate) use braking::stop_accelerations;
pub(crate) use joint_states::longer_s;
pub use joint_states::{Advance, JointStateSource, SimulatedRobot, SourceError, SourcePose};
pub use recorded::RecordedSource;
pub(crate) use run_source::RunSource;
pub use simulated_dynamics::SimulatedDynamics;
pub use simulated_poses::SimulatedPoses;
pub use simulation::SimulationSource;
pub use stream_progress::{StreamPosition, StreamProgress};
