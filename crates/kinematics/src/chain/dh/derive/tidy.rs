//! Rounds values to a short form if they differ from it only by rounding noise.

use std::f64::consts::PI;

use nalgebra::Matrix3;

use crate::spatial::pose::Pose;

/// Steps per metre, radian and degree that a written value may have: ten digits after the point.
const STEPS: f64 = 1e10;

/// The nearest value with ten digits if it is within `tolerance`; otherwise the value itself.
pub(super) fn number(value: f64, tolerance: f64) -> f64 {
    let short = (value * STEPS).round() / STEPS;
    // Adding zero turns a negative zero into a positive one.
    (if (short - value).abs() <= tolerance { short } else { value }) + 0.0
}

/// The same for an angle, in degrees first; in `-pi < angle <= pi`, the half turn always positive.
pub(super) fn angle(value_rad: f64, tolerance: f64) -> f64 {
    // Degrees first, since that is what the angle was written in: 30 degrees have no short form in radians.
    let degrees = ((value_rad.to_degrees() * STEPS).round() / STEPS).to_radians();
    let is_short = (degrees - value_rad).abs() <= tolerance;
    let tidied = if is_short { degrees + 0.0 } else { number(value_rad, tolerance) };
    if tidied <= -PI { tidied + 2.0 * PI } else { tidied }
}

/// The same for a pose: lengths, and entries of the rotation that are nearly 0, 1 or -1.
pub(super) fn pose(value: &Pose, tolerance: f64) -> Pose {
    let entry = |entry: f64| {
        // Only these entries: any other, shortened alone, would spoil the orthonormality of the matrix.
        let whole = entry.round();
        (if (whole - entry).abs() <= tolerance { whole } else { entry }) + 0.0
    };
    let rotation: Matrix3<f64> = value.rotation.map(entry);
    Pose { rotation, translation: value.translation.map(|length| number(length, tolerance)) }
}
