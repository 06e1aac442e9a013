//! Figures as they are written into files: short where that loses nothing, with all digits otherwise.

use nalgebra::{Isometry3, Vector3};

/// How far an angle written in degrees may be from the one in memory. Kind: rounding of the unit
/// change, two operations on numbers up to pi.
const WRITTEN_RAD: f64 = 1e-15;
/// Steps per degree that count as a short figure.
const DEGREE_STEPS: f64 = 1e6;

/// A number with all its digits, without a negative zero.
pub(crate) fn number(value: f64) -> String {
    format!("{:?}", value + 0.0)
}

/// Numbers with this between them.
pub(crate) fn numbers(values: impl IntoIterator<Item = f64>, between: &str) -> String {
    values.into_iter().map(number).collect::<Vec<_>>().join(between)
}

/// The same angle in degrees, where few digits say it.
pub(crate) fn short_degrees(angle_rad: f64) -> Option<f64> {
    let degrees = (angle_rad.to_degrees() * DEGREE_STEPS).round() / DEGREE_STEPS;
    ((degrees.to_radians() - angle_rad).abs() <= WRITTEN_RAD).then_some(degrees)
}

/// Turns about the fixed axes x, then y, then z. At a pitch of a quarter turn, where only the sum of
/// the other two counts, yaw takes what it can and roll follows, so that no digit is lost.
pub(crate) fn rpy_fixed_xyz_rad(pose: &Isometry3<f64>) -> [f64; 3] {
    let matrix = pose.rotation.to_rotation_matrix();
    let m = |row: usize, column: usize| matrix[(row, column)];
    let yaw = m(1, 0).atan2(m(0, 0));
    let (sin, cos) = yaw.sin_cos();
    let pitch = (-m(2, 0)).atan2(cos * m(0, 0) + sin * m(1, 0));
    let roll = (sin * m(0, 2) - cos * m(1, 2)).atan2(cos * m(1, 1) - sin * m(0, 1));
    [roll, pitch, yaw]
}

/// Whether a pose moves nothing, to the last digit.
pub(crate) fn is_identity(pose: &Isometry3<f64>) -> bool {
    pose.translation.vector == Vector3::zeros() && pose.rotation.angle() == 0.0
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use nalgebra::UnitQuaternion;

    use super::*;
    use crate::written_transform::rotation_from_rpy_fixed_xyz;

    #[test]
    fn turns_come_back_from_their_angles() {
        /// Rounding of a dozen products of numbers below 1; worst seen 5e-16.
        const ROUNDING_RAD: f64 = 4e-15;
        let angles = [0.0, 0.3, FRAC_PI_2, -FRAC_PI_2, FRAC_PI_2 - 1e-9, FRAC_PI_2 + 2.05e-10, 3.0];
        for roll in angles {
            for pitch in angles {
                for yaw in angles {
                    let rotation = rotation_from_rpy_fixed_xyz([roll, pitch, yaw]);
                    let pose = Isometry3::from_parts(Vector3::zeros().into(), rotation);
                    let back: UnitQuaternion<f64> = rotation_from_rpy_fixed_xyz(rpy_fixed_xyz_rad(&pose));
                    // Twice the sine of half the angle: the arc cosine would lose half of the digits.
                    let angle = 2.0 * (back.inverse() * rotation).imag().norm();
                    assert!(angle <= ROUNDING_RAD, "{roll} {pitch} {yaw}: {angle:e}");
                }
            }
        }
    }

    #[test]
    fn angles_are_short_only_where_nothing_is_lost() {
        assert_eq!(short_degrees(FRAC_PI_2), Some(90.0));
        assert_eq!(short_degrees(FRAC_PI_2 + 2.05e-10), None);
        assert_eq!(number(-0.0), "0.0");
    }
}
