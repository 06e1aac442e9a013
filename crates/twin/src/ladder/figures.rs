//! Figures as reports print them.

use congruent_kinematics::Pose;
use nalgebra::Rotation3;
use serde::Serialize;

/// What stands somewhere, or should.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Figure {
    /// A number in rad, m, or without unit.
    Number(f64),
    /// Several, or a word.
    Text(String),
}

/// A fitted number without the digits that only its rounding fills.
pub(super) fn short(value: f64) -> String {
    /// Decimals that a fit can stand for.
    const FITTED: f64 = 1e12;
    let rounded = (value * FITTED).round() / FITTED;
    format!("{}", rounded + 0.0)
}

/// A transform as a robot file writes it.
pub(super) fn transform(pose: &Pose) -> String {
    let (roll, pitch, yaw) = Rotation3::from_matrix_unchecked(pose.rotation).euler_angles();
    let list = |numbers: [f64; 3]| numbers.map(short).join(", ");
    let translation = [pose.translation.x, pose.translation.y, pose.translation.z];
    format!("{{ xyz_m = [{}], rpy_rad = [{}] }}", list(translation), list([roll, pitch, yaw]))
}

/// Millimetres where a hand could measure them, otherwise metres with an exponent.
pub(super) fn length(metres: f64) -> String {
    if metres >= 1e-6 { format!("{:.4} mm", metres * 1e3) } else { format!("{metres:.1e} m") }
}

/// Degrees where an eye could see them, otherwise radians with an exponent.
pub(super) fn angle(radians: f64) -> String {
    if radians >= 1e-6 { format!("{:.5} deg", radians.to_degrees()) } else { format!("{radians:.1e} rad") }
}
