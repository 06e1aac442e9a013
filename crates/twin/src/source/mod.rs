//! Sources of link poses and of joint states. A run takes any source of joint states.

mod joint_states;
mod simulated_poses;
mod simulation;

pub use joint_states::{JointSample, JointStateSource, JointStateView, SetpointView, SourceError};
pub use simulated_poses::SimulatedPoses;
pub use simulation::SimulationSource;
