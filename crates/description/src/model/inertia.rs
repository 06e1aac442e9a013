//! Mass, centre of mass and rotational inertia of a link.

use nalgebra::{Isometry3, Matrix3};

/// Inertia of a link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inertia {
    /// Mass.
    pub mass_kg: f64,
    /// Pose of the inertial frame in the link; its origin is the centre of mass.
    pub link_from_inertial: Isometry3<f64>,
    /// Rotational inertia about the centre of mass, in the axes of the inertial frame.
    pub tensor_kg_m2: Matrix3<f64>,
}
