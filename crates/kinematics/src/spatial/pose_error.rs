//! How far two poses are apart.

use congruent_description::Tolerance;
use nalgebra::Isometry3;
use schemars::JsonSchema;
use serde::Serialize;

use super::pose::Pose;

/// The difference of two poses: distance of the origins and angle between the orientations.
///
/// The angle is that of the relative rotation, from `atan2(|vee(R - R')| / 2, (tr R - 1) / 2)`, which is
/// accurate at 0 and at pi.
///
/// # Examples
/// ```
/// use congruent_kinematics::{Pose, PoseError};
/// use nalgebra::Isometry3;
/// let shifted = Pose::from(Isometry3::translation(0.003, 0.0, 0.004));
/// let error = PoseError::between(&Pose::identity(), &shifted);
/// assert_eq!(error, PoseError { position_m: 0.005, orientation_rad: 0.0 });
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, JsonSchema)]
pub struct PoseError {
    /// Distance of the origins.
    pub position_m: f64,
    /// Angle between the orientations.
    pub orientation_rad: f64,
}

impl PoseError {
    /// Between two poses of one frame.
    pub fn between(a: &Pose, b: &Pose) -> Self {
        Self { position_m: a.distance_m(b), orientation_rad: a.angle_rad(b) }
    }

    /// Between a pose by analysis and the same frame's pose as an isometry.
    pub fn to_isometry(pose: &Pose, isometry: &Isometry3<f64>) -> Self {
        Self::between(pose, &Pose::from(*isometry))
    }

    /// The larger of each; NaN is the largest of all.
    #[must_use]
    pub fn larger(self, other: Self) -> Self {
        Self {
            position_m: larger(self.position_m, other.position_m),
            orientation_rad: larger(self.orientation_rad, other.orientation_rad),
        }
    }

    /// Whether both are within a tolerance; NaN never is.
    pub fn is_within(&self, tolerance: &Tolerance) -> bool {
        self.position_m <= tolerance.position_m && self.orientation_rad <= tolerance.orientation_rad
    }
}

/// The larger of two. `f64::max` would drop a NaN, and a NaN is the largest of all.
pub fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b <= a { a } else { b }
}
