//! One row of measurements, as the file gives it.

use congruent_description::RobotQ;
use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector4};

/// How far a quaternion's norm may be from 1. Kind: digits of the file; four decimals give 1e-4.
const NORM_DIGITS: f64 = 1e-3;

/// One measured row: joint positions, and the position or orientation of the tip.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredRow {
    /// Line in the file, from 1.
    pub line: usize,
    /// Configuration vector of the robot, rad and m.
    pub q: RobotQ,
    /// Measured position in link `base`, m; `None` for a coordinate that was not measured.
    pub tip_in_base_m: [Option<f64>; 3],
    /// Measured orientation in link `base`.
    pub orientation: Option<WrittenOrientation>,
}

/// An orientation as the file gives it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum WrittenOrientation {
    /// A quaternion of unit length within the digits of the file.
    QuaternionWxyz([f64; 4]),
    /// `Rz(yaw) Ry(pitch) Rx(roll)`, rad.
    RpyRad([f64; 3]),
    /// Axis times angle, rad, as of a controller of Universal Robots and of `OpenCV`.
    RotationVectorRad([f64; 3]),
}

impl WrittenOrientation {
    /// # Errors
    /// The quaternion is not of unit length.
    pub(super) fn from_quaternion_wxyz(quaternion: [f64; 4]) -> Result<Self, String> {
        let norm = Quaternion::from(Vector4::from(quaternion)).norm();
        if (norm - 1.0).abs() > NORM_DIGITS {
            return Err(format!("the quaternion has norm {norm:.6}, expected 1 within {NORM_DIGITS}"));
        }
        Ok(Self::QuaternionWxyz(quaternion))
    }

    /// The rotation from the measured frame to link `base`.
    pub fn base_from_tip(&self) -> Matrix3<f64> {
        match *self {
            Self::QuaternionWxyz([w, x, y, z]) => {
                UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z)).to_rotation_matrix().into_inner()
            }
            Self::RpyRad([roll, pitch, yaw]) => Rotation3::from_euler_angles(roll, pitch, yaw).into_inner(),
            Self::RotationVectorRad(vector) => Rotation3::new(vector.into()).into_inner(),
        }
    }
}
