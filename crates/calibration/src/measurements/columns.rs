//! Columns of a table of measurements, by their names.

use congruent_description::{JointKind, Robot};
use congruent_input::{
    Diagnostic, known_names,
    units::{Unit, WrittenUnit},
};

use crate::codes;

/// Names of the measured quantities, those with a unit without it.
const POSITION: [&str; 3] = ["x", "y", "z"];
const RPY: [&str; 3] = ["roll", "pitch", "yaw"];
const ROTATION_VECTOR: [&str; 3] = ["rx", "ry", "rz"];
/// Those that need a unit in the name of their column.
const WITH_UNIT: [[&str; 3]; 3] = [POSITION, RPY, ROTATION_VECTOR];
const QUATERNION: [&str; 4] = ["qw", "qx", "qy", "qz"];

/// The quantity in a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum MeasuredQuantity {
    /// A joint's position, by its index in the configuration vector.
    Joint(usize),
    /// Coordinate x, y or z of the tip in the base.
    Position(usize),
    /// Component w, x, y or z of the orientation as a quaternion.
    Quaternion(usize),
    /// Roll, pitch or yaw of the orientation.
    Rpy(usize),
    /// Component x, y or z of the orientation as a rotation vector.
    RotationVector(usize),
}

/// A column with the conversion of its values to SI.
#[derive(Debug, Clone, Copy)]
pub(super) struct MeasurementColumn {
    pub(super) quantity: MeasuredQuantity,
    /// The unit in the column's name; a component of a quaternion has none.
    unit: Option<WrittenUnit>,
}

impl MeasurementColumn {
    /// A value of the column in rad or m.
    pub(super) fn to_si(self, value: f64) -> f64 {
        self.unit.map_or(value, |unit| unit.to_si(value))
    }

    /// The column with this name.
    ///
    /// # Errors
    /// The name is neither a joint nor a measured quantity, or its unit does not fit.
    pub(super) fn parse(name: &str, robot: &Robot) -> Result<Self, Diagnostic> {
        if let Some(at) = QUATERNION.iter().position(|known| *known == name) {
            return Ok(Self { quantity: MeasuredQuantity::Quaternion(at), unit: None });
        }
        let Some((stem, suffix)) = WrittenUnit::split(name) else { return Err(without_unit(name, robot)) };
        let (unit, written) = (suffix.unit, Some(suffix));
        let joint = robot.find_joint(stem).and_then(|joint| Some((joint, robot.coordinate(joint)?)));
        let measured = match unit {
            Unit::Length => POSITION.iter().position(|known| *known == stem).map(MeasuredQuantity::Position),
            // Joints have such names, too; an orientation can be given as a quaternion.
            Unit::Angle if joint.is_some() => None,
            Unit::Angle => {
                let of = |names: [&str; 3]| names.into_iter().position(|known| known == stem);
                let rpy = of(RPY).map(MeasuredQuantity::Rpy);
                rpy.or_else(|| of(ROTATION_VECTOR).map(MeasuredQuantity::RotationVector))
            }
        };
        if let Some(quantity) = measured {
            return Ok(Self { quantity, unit: written });
        }
        let Some((joint, coordinate)) = joint else { return Err(unknown(name, stem, robot)) };
        let expected =
            if robot.joint(joint).kind == JointKind::Prismatic { Unit::Length } else { Unit::Angle };
        if expected != unit {
            let [plain, engineering_unit] = expected.keys(stem);
            let message = format!("column \"{name}\" has the wrong unit for its joint");
            return Err(Diagnostic::error(codes::measurements::UNIT, message)
                .with_help(format!("write {plain} or {engineering_unit}")));
        }
        Ok(Self { quantity: MeasuredQuantity::Joint(coordinate), unit: written })
    }
}

fn without_unit(name: &str, robot: &Robot) -> Diagnostic {
    let is_known = robot.find_joint(name).is_some() || WITH_UNIT.as_flattened().contains(&name);
    if !is_known {
        return unknown(name, name, robot);
    }
    Diagnostic::error(codes::measurements::UNIT, format!("column \"{name}\" has no unit in its name"))
        .with_help("add _rad or _deg for an angle, _m or _mm for a length")
}

fn unknown(name: &str, stem: &str, robot: &Robot) -> Diagnostic {
    if name.contains([';', '\t']) {
        let message = format!("column name \"{name}\" contains a semicolon or a tab");
        return Diagnostic::error(codes::measurements::UNKNOWN_COLUMN, message)
            .with_help("separate columns with commas, and write decimals with a point");
    }
    let mut known: Vec<&str> = robot.movable_joint_names().collect();
    known.extend(QUATERNION);
    known.extend(WITH_UNIT.concat());
    let message =
        format!("column \"{name}\" is neither a joint of robot \"{}\" nor a measured quantity", robot.name());
    Diagnostic::error(codes::measurements::UNKNOWN_COLUMN, message).with_help(known_names(
        stem,
        "columns (with _rad, _deg, _m or _mm)",
        known,
    ))
}
