//! Obstacles that move: along a path, or carried by the tool.

mod moving_bodies;
mod moving_body;

pub use moving_bodies::MovingBodies;
pub use moving_body::{BodyTrack, Grasp, MovingBody, PathPose};
