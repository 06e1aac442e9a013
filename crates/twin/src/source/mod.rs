//! Where link poses and joint states come from. A run takes a source and does not know which it is.

mod joint_states;
mod simulated_poses;
mod simulation;

pub use joint_states::{JointSample, JointStateSource, JointStateView, SetpointView, SourceError};
pub use simulated_poses::SimulatedPoses;
pub use simulation::SimulationSource;
