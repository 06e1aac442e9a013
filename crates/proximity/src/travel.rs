//! Upper bound of the motion of a body, which the lower bounds of distances are reduced by.

use nalgebra::{Isometry3, Vector3};

/// Largest motion, in a's frame, of any point within `radius_m` of b's origin, m.
pub(super) fn largest_shift_m(before: &Isometry3<f64>, after: &Isometry3<f64>, radius_m: f64) -> f64 {
    let shift_m = (after.translation.vector - before.translation.vector).norm();
    // A turn by an angle t moves a point at radius r along a chord of 2 r sin(t / 2), and the
    // vector part of the turn's unit quaternion has length sin(t / 2).
    let half_turn: Vector3<f64> = before.rotation.rotation_to(&after.rotation).imag();
    shift_m + 2.0 * radius_m * half_turn.norm()
}
