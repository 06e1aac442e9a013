//! Where the frame of a joint is put on the axis of its screw.

use nalgebra::{Isometry3, Unit, Vector3};

/// Components below this are written as 0. Kind: rounding of a dozen products within 2 m.
const NOISE: f64 = 1e-15;

/// The axis of a joint, and the point of it at which a frame parallel to the base is put.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlacedAxis {
    /// Whether the joint turns.
    pub is_angular: bool,
    /// Direction of the axis, in the base.
    pub axis_in_base: Unit<Vector3<f64>>,
    /// Origin of the joint's frame, m, in the base.
    pub origin_in_base: Vector3<f64>,
}

impl PlacedAxis {
    /// The axis of a twist at position zero, in the base: `angular` in rad, `linear` in m per unit of the joint, one of them of
    /// length 1. The origin is the point of the axis nearest to `here_in_base`, the origin of the joint before: links stay
    /// short, and models of one robot get the same frames whatever they were written as. A joint that slides is put there.
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), sec. 3.3.2.2: `linear = -angular x q` for each point `q` of the axis.
    ///
    /// # Examples
    /// A vertical axis through (0.6, 0, 0):
    /// ```
    /// use congruent_description::PlacedAxis;
    /// use nalgebra::Vector3;
    /// let here_in_base = Vector3::new(0.0, 0.0, 0.4);
    /// let placed = PlacedAxis::on_screw(&Vector3::z(), &Vector3::new(0.0, -0.6, 0.0), &here_in_base);
    /// assert_eq!(placed.origin_in_base, Vector3::new(0.6, 0.0, 0.4));
    /// ```
    pub fn on_screw(angular: &Vector3<f64>, linear: &Vector3<f64>, here_in_base: &Vector3<f64>) -> Self {
        let is_angular = angular.norm() > linear.norm() * NOISE;
        if !is_angular {
            let axis_in_base = Unit::new_normalize(linear.map(clean));
            return Self { is_angular, axis_in_base, origin_in_base: *here_in_base };
        }
        let axis_in_base = Unit::new_normalize(angular.map(clean));
        let on_axis = axis_in_base.cross(linear);
        let nearest = on_axis + axis_in_base.into_inner() * (here_in_base - on_axis).dot(&axis_in_base);
        Self { is_angular, axis_in_base, origin_in_base: nearest.map(clean) }
    }

    /// The shift from the frame of the joint before, which is parallel.
    pub fn shift_from(&self, here_in_base: &Vector3<f64>) -> Isometry3<f64> {
        let by = (self.origin_in_base - here_in_base).map(clean);
        Isometry3::translation(by.x, by.y, by.z)
    }

    /// The pose of the tip in the last frame, which is at `here_in_base`; the tip keeps its own orientation.
    pub fn last_shift(base_from_tip: &Isometry3<f64>, here_in_base: &Vector3<f64>) -> Isometry3<f64> {
        let mut last = *base_from_tip;
        last.translation.vector = (last.translation.vector - here_in_base).map(clean);
        last
    }
}

fn clean(component: f64) -> f64 {
    if component.abs() < NOISE { 0.0 } else { component }
}
