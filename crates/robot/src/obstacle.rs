//! A body around the robot.

use nalgebra::Isometry3;

use super::geometry::Geometry;

/// A body around the robot.
#[derive(Debug, Clone, PartialEq)]
pub struct Obstacle {
    /// Name, as in the scenario.
    pub name: String,
    /// Pose of the shape's frame in the world at first, m.
    pub world_from_obstacle: Isometry3<f64>,
    /// The shape, m; of a mesh, the convex hull has contacts.
    pub geometry: Geometry,
}
