//! Figures as they are written into files: short where that loses nothing, with all digits otherwise.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Isometry3, Rotation3, Vector3};

use crate::written_transform::rotation_from_rpy_fixed_xyz;

/// How far an angle written in degrees may be from the one in memory. Kind: rounding of the unit
/// change, two operations on numbers up to pi.
const WRITTEN_RAD: f64 = 1e-15;
/// Steps per degree that count as a short figure.
const DEGREE_STEPS: f64 = 1e6;

/// A number with all its digits, without a negative zero.
pub(crate) fn number(value: f64) -> String {
    format!("{:?}", value + 0.0)
}

/// How far a fitted figure may be from the one that is written for it, in m or rad, relative above 1.
/// Kind: rounding of a fit on some hundred numbers, two digits above eps.
const FITTED: f64 = 5e-14;

/// A fitted number (m, rad, or without unit) by the fewest decimals that say the same: a fit fills all
/// digits with its rounding.
pub fn fitted_number(value: f64) -> String {
    fitted_in(value, 1.0)
}

/// The same in a unit of which `one` make a metre or a radian.
pub(crate) fn fitted_in(value: f64, one: f64) -> String {
    /// More decimals than any number within [`FITTED`] needs.
    const MOST_DECIMALS: usize = 15;
    let is_near = |text: &String| {
        let off = text.parse::<f64>().map_or(f64::INFINITY, |written| (written - value).abs());
        off <= FITTED * value.abs().max(one)
    };
    let near = (0..MOST_DECIMALS).map(|decimals| format!("{value:.decimals$}")).find(is_near);
    match near.unwrap_or_else(|| format!("{value:?}")) {
        negative if negative == "-0" => "0".to_owned(),
        shortest => shortest,
    }
}

/// Fitted numbers without unit as a list.
pub(crate) fn fitted_list(values: impl IntoIterator<Item = f64>) -> String {
    format!("[{}]", values.into_iter().map(fitted_number).collect::<Vec<_>>().join(", "))
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
    rpy_at_yaw(&matrix, matrix[(1, 0)].atan2(matrix[(0, 0)]))
}

/// The same for a fitted rotation: without yaw where roll and a pitch within a quarter turn say the
/// same, as where pitch is one and yaw would be what the fit's rounding makes of it.
pub(crate) fn fitted_rpy_fixed_xyz_rad(pose: &Isometry3<f64>) -> [f64; 3] {
    let matrix = pose.rotation.to_rotation_matrix();
    let without_yaw = rpy_at_yaw(&matrix, 0.0);
    let off = rotation_from_rpy_fixed_xyz(without_yaw).to_rotation_matrix().matrix() - matrix.matrix();
    let is_within = without_yaw[1].abs() <= FRAC_PI_2 + FITTED;
    if is_within && off.amax() <= FITTED { without_yaw } else { rpy_fixed_xyz_rad(pose) }
}

fn rpy_at_yaw(matrix: &Rotation3<f64>, yaw: f64) -> [f64; 3] {
    let m = |row: usize, column: usize| matrix[(row, column)];
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
    use nalgebra::UnitQuaternion;

    use super::*;

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

    #[test]
    fn fitted_numbers_are_as_short_as_they_may_be() {
        for (value, written) in [
            (0.1 - 1e-16, "0.1"),
            (-1e-14, "0"),
            (-0.392_200_000_000_000_3, "-0.3922"),
            (90.0 + 1e-12, "90"),
            (FRAC_PI_2, "1.5707963267949"),
            (1e-12, "0.000000000001"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(fitted_number(value), written);
        }
    }
}
