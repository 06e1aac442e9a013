//! Links: the rigid parts of a robot, with their mass and shapes.

use super::{geometry::Shape, inertia::Inertia, rounding::InertiaRounding};

/// Position of a link in [`Robot::links`](crate::Robot::links).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct LinkIndex(pub(crate) usize);

impl LinkIndex {
    /// The index as a number, for addressing arrays laid out like [`Robot::links`](crate::Robot::links).
    pub fn get(self) -> usize {
        self.0
    }
}

/// One rigid part of a [`Robot`](crate::Robot).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Link {
    /// Name, unique in the robot.
    pub name: String,
    /// Mass and rotational inertia; `None` for a link without an `<inertial>`.
    pub inertia: Option<Inertia>,
    /// How far the inertia may be from the truth because of the digits that it is written with.
    pub inertia_rounding: InertiaRounding,
    /// Shapes that are drawn, in the link frame.
    pub visuals: Vec<Shape>,
    /// Shapes for distances and contacts, in the link frame.
    pub collisions: Vec<Shape>,
}
