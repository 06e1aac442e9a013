//! Where link poses and joint states come from.

mod simulated_poses;

pub use simulated_poses::SimulatedPoses;
