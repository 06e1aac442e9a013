//! Positions and orientations in rerun's types, which are in single precision: a tenth of a micrometre at one
//! metre. Errors are recorded as scalars in double precision and never read back from poses.

use nalgebra::{Isometry3, Vector3};
use re_sdk_types::datatypes::Quaternion;

/// A position or a direction.
pub(crate) fn vector(vector: &Vector3<f64>) -> [f32; 3] {
    [single(vector.x), single(vector.y), single(vector.z)]
}

/// The rotation of a pose.
pub(crate) fn quaternion(pose: &Isometry3<f64>) -> Quaternion {
    Quaternion::from_xyzw(pose.rotation.coords.map(single).into())
}

/// The nearest value in single precision.
#[expect(clippy::cast_possible_truncation, reason = "rerun draws in single precision")]
pub(crate) fn single(value: f64) -> f32 {
    value as f32
}
