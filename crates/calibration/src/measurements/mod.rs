//! Measurements as files give them: joint positions by name, and where the tip was seen.

mod columns;
mod csv;
mod json;

use std::path::Path;

use congruent_description::{Diagnostic, Robot, RobotQ, read_text};
use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector4};

/// Largest file that is read.
const MOST_BYTES: u64 = 64 << 20;
/// How far a quaternion's norm may be from 1. Kind: digits of the file; four decimals give 1e-4.
const NORM_DIGITS: f64 = 1e-3;
/// Largest joint position or coordinate of the tip, rad and m.
const MOST: f64 = 1e6;

/// One measured row.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredRow {
    /// Line in the file, from 1.
    pub line: usize,
    /// Configuration vector of the robot, rad and m.
    pub q: RobotQ,
    /// Measured position in link `base`, m; `None` where a coordinate was not measured.
    pub tip_in_base_m: [Option<f64>; 3],
    /// Measured orientation in link `base`.
    pub orientation: Option<WrittenOrientation>,
}

/// An orientation in the figures of the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum WrittenOrientation {
    /// A quaternion that is of unit length but for its digits.
    QuaternionWxyz([f64; 4]),
    /// `Rz(yaw) Ry(pitch) Rx(roll)`, rad.
    RpyRad([f64; 3]),
}

impl WrittenOrientation {
    /// # Errors
    /// The figures are not of unit length.
    fn from_quaternion_wxyz(figures: [f64; 4]) -> Result<Self, String> {
        let norm = Quaternion::from(Vector4::from(figures)).norm();
        if (norm - 1.0).abs() > NORM_DIGITS {
            return Err(format!("quaternion of norm {norm:.6}, a rotation has norm 1"));
        }
        Ok(Self::QuaternionWxyz(figures))
    }

    /// The rotation.
    pub fn base_from_tip(&self) -> Matrix3<f64> {
        match *self {
            Self::QuaternionWxyz([w, x, y, z]) => {
                UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z)).to_rotation_matrix().into_inner()
            }
            Self::RpyRad([roll, pitch, yaw]) => Rotation3::from_euler_angles(roll, pitch, yaw).into_inner(),
        }
    }
}

/// Reads a CSV or JSON file of measurements; each of `needed` (coordinates of the configuration
/// vector) must be given in every row.
///
/// A file whose first character is `[` is JSON: an array of `{"q": {joint: rad or m},
/// "translation_m": [x, y, z], "quaternion_wxyz": [w, x, y, z]}`, with `translation_mm`, `rpy_deg`,
/// `rpy_rad` as alternatives. Anything else is CSV with a header: `<joint>_rad`, `<joint>_deg`,
/// `<joint>_m` or `<joint>_mm`, then `x_m`, `y_m`, `z_m` (or `_mm`), and optionally `qw`, `qx`, `qy`, `qz`
/// or `roll_deg`, `pitch_deg`, `yaw_deg` (or `_rad`). A coordinate may be left out, and a measured cell
/// be empty; lines that start with `#` are comments.
///
/// # Errors
/// Every fault that was found, with its line and column.
pub fn read_measurements(
    path: &Path,
    robot: &Robot,
    needed: &[usize],
) -> Result<Vec<MeasuredRow>, Vec<Diagnostic>> {
    let source = read_text(path, MOST_BYTES).map_err(|fault| vec![fault])?;
    let rows = if source.text.trim_start().starts_with(['[', '{']) {
        json::parse(&source.text, robot, needed)
    } else {
        csv::parse(&source.text, robot, needed)
    };
    let rows = rows.and_then(|rows| if rows.is_empty() { Err(vec![no_rows()]) } else { Ok(rows) });
    rows.map_err(|faults| faults.into_iter().map(|fault| fault.in_file(&source)).collect())
}

fn no_rows() -> Diagnostic {
    Diagnostic::error("measurements::none", "the file holds no measurement").at(0..0)
}

/// The joints that every row must give but does not.
fn missing_joints(robot: &Robot, needed: &[usize], is_given: impl Fn(usize) -> bool) -> Option<String> {
    let joint = |coordinate: usize| robot.joint(robot.movable_joints()[coordinate]);
    let missing: Vec<&str> = needed
        .iter()
        .filter(|&&coordinate| joint(coordinate).mimic.is_none() && !is_given(coordinate))
        .map(|&coordinate| joint(coordinate).name.as_str())
        .collect();
    (!missing.is_empty()).then(|| missing.join(", "))
}

/// Refuses a figure, in rad or m, that no robot has and whose square would drown all others.
fn plausible(figure: f64) -> Result<f64, String> {
    if figure.abs() <= MOST { Ok(figure) } else { Err(format!("is beyond {MOST:e} rad or m")) }
}
