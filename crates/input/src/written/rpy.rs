//! Roll, pitch and yaw: turns about the fixed axes x, then y, then z, as URDF and robot files write rotations.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Isometry3, Matrix3, Rotation3, UnitQuaternion, Vector3};

use super::number::{FITTED, Slack};

/// The rotation that turns about the fixed axes x, then y, then z: `Rz(yaw) Ry(pitch) Rx(roll)`.
pub fn rotation_from_rpy_fixed_xyz([roll, pitch, yaw]: [f64; 3]) -> UnitQuaternion<f64> {
    UnitQuaternion::from_euler_angles(roll, pitch, yaw)
}

/// The axes about which more roll, pitch and yaw turn a rotation, in the frame in which it is written.
///
/// With `R = Rz(yaw) Ry(pitch) Rx(roll)`, yaw turns about the fixed z, roll about the x of the result, and pitch about the y
/// between the two, which is at right angles to both; at a pitch of a quarter turn, where these are parallel, about the y of the
/// result.
pub fn axes_of_rpy_fixed_xyz(rotation: &Matrix3<f64>) -> [Vector3<f64>; 3] {
    let (roll, yaw) = (rotation.column(0).into_owned(), Vector3::z());
    let pitch = yaw.cross(&roll).try_normalize(f64::EPSILON);
    [roll, pitch.unwrap_or_else(|| rotation.column(1).into_owned()), yaw]
}

/// Turns about the fixed axes x, then y, then z. At a pitch of a quarter turn, at which only
/// the sum of the other two counts, yaw is read from the matrix and roll follows, so that no digit is lost.
pub fn rpy_fixed_xyz_rad(pose: &Isometry3<f64>) -> [f64; 3] {
    let matrix = pose.rotation.to_rotation_matrix();
    rpy_at_yaw(&matrix, libm::atan2(matrix[(1, 0)], matrix[(0, 0)]))
}

/// The same for a fitted rotation: without yaw if roll and a pitch within a quarter turn say the same.
/// At a pitch of a quarter turn yaw would be whatever the fit's rounding makes of it.
pub fn fitted_rpy_fixed_xyz_rad(pose: &Isometry3<f64>, slack: Slack) -> [f64; 3] {
    let near = slack.angle_rad.max(FITTED);
    let matrix = pose.rotation.to_rotation_matrix();
    let without_yaw = rpy_at_yaw(&matrix, 0.0);
    let off = rotation_from_rpy_fixed_xyz(without_yaw).to_rotation_matrix().matrix() - matrix.matrix();
    let is_within = without_yaw[1].abs() <= FRAC_PI_2 + near;
    if is_within && off.amax() <= near { without_yaw } else { rpy_fixed_xyz_rad(pose) }
}

fn rpy_at_yaw(matrix: &Rotation3<f64>, yaw: f64) -> [f64; 3] {
    let m = |row: usize, column: usize| matrix[(row, column)];
    // With R = Rz(yaw) Ry(pitch) Rx(roll), the matrix Rz(-yaw) R = Ry(pitch) Rx(roll) has cos(pitch) and -sin(pitch) in its
    // first column, and cos(roll) and sin(roll) in its second row. The arguments below are those entries, so no division by
    // cos(pitch) loses digits near a pitch of a quarter turn.
    let (sin, cos) = libm::sincos(yaw);
    let pitch = libm::atan2(-m(2, 0), cos * m(0, 0) + sin * m(1, 0));
    let roll = libm::atan2(sin * m(0, 2) - cos * m(1, 2), cos * m(1, 1) - sin * m(0, 1));
    [roll, pitch, yaw]
}

#[cfg(test)]
mod tests {
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
}
