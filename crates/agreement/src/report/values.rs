//! Figures as reports print them.

use congruent_kinematics::Pose;
use nalgebra::{Isometry3, Rotation3, Translation3, UnitQuaternion};
use serde::Serialize;

/// What stands somewhere, or should.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum ReportedValue {
    /// A number in rad, m, or without unit.
    Number(f64),
    /// Several, or a word.
    Text(String),
}

/// A pose as files know it.
pub(super) fn isometry(pose: &Pose) -> Isometry3<f64> {
    let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(pose.rotation));
    Isometry3::from_parts(Translation3::from(pose.translation), rotation)
}

/// Millimetres where a hand could measure them, otherwise metres with an exponent.
pub(super) fn length(metres: f64) -> String {
    if metres >= 1e-6 { format!("{:.4} mm", metres * 1e3) } else { format!("{metres:.1e} m") }
}

/// Degrees where an eye could see them, otherwise radians with an exponent.
pub(super) fn angle(radians: f64) -> String {
    if radians >= 1e-6 { format!("{:.5} deg", radians.to_degrees()) } else { format!("{radians:.1e} rad") }
}
