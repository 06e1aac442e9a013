//! Columns of a table of measurements, by their names.

use congruent_description::{Diagnostic, JointKind, Robot, known_names, units::Unit};

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum MeasuredQuantity {
    /// A joint's position: a coordinate of the configuration vector.
    Joint(usize),
    /// x, y or z of the tip.
    Position(usize),
    /// w, x, y or z of a quaternion.
    Quaternion(usize),
    /// Roll, pitch or yaw.
    Rpy(usize),
}

/// A column and how its values become SI.
#[derive(Debug, Clone, Copy)]
pub(super) struct Column {
    pub(super) quantity: MeasuredQuantity,
    /// The quantity if its values are in degrees or millimetres; `None` for SI.
    handy: Option<Unit>,
}

impl Column {
    /// A value of the column in rad or m.
    pub(super) fn to_si(self, value: f64) -> f64 {
        self.handy.map_or(value, |unit| unit.convert(value))
    }

    /// The column of a name.
    ///
    /// # Errors
    /// The name is no joint or measured quantity with a fitting unit.
    pub(super) fn parse(name: &str, robot: &Robot) -> Result<Self, Diagnostic> {
        if let Some(at) = ["qw", "qx", "qy", "qz"].iter().position(|known| *known == name) {
            return Ok(Self { quantity: MeasuredQuantity::Quaternion(at), handy: None });
        }
        let split = [
            ("_rad", Unit::Angle, false),
            ("_deg", Unit::Angle, true),
            ("_mm", Unit::Length, true),
            ("_m", Unit::Length, false),
        ]
        .into_iter()
        .find_map(|(suffix, unit, is_handy)| Some((name.strip_suffix(suffix)?, unit, is_handy)));
        let Some((stem, unit, is_handy)) = split else { return Err(without_unit(name, robot)) };
        let handy = is_handy.then_some(unit);
        let joint = robot.find_joint(stem).and_then(|joint| Some((joint, robot.coordinate(joint)?)));
        let measured = match unit {
            Unit::Length => {
                ["x", "y", "z"].iter().position(|known| *known == stem).map(MeasuredQuantity::Position)
            }
            // Joints have such names, too; an orientation can be given as a quaternion.
            Unit::Angle if joint.is_some() => None,
            Unit::Angle => {
                ["roll", "pitch", "yaw"].iter().position(|known| *known == stem).map(MeasuredQuantity::Rpy)
            }
        };
        if let Some(quantity) = measured {
            return Ok(Self { quantity, handy });
        }
        let Some((joint, coordinate)) = joint else { return Err(unknown(name, stem, robot)) };
        let expected =
            if robot.joint(joint).kind == JointKind::Prismatic { Unit::Length } else { Unit::Angle };
        let fits = matches!((expected, unit), (Unit::Length, Unit::Length) | (Unit::Angle, Unit::Angle));
        if !fits {
            let [plain, handy] = expected.keys(stem);
            let message = format!("column \"{name}\" has the wrong unit for its joint");
            return Err(Diagnostic::error("measurements::unit", message)
                .with_help(format!("write {plain} or {handy}")));
        }
        Ok(Self { quantity: MeasuredQuantity::Joint(coordinate), handy })
    }
}

fn without_unit(name: &str, robot: &Robot) -> Diagnostic {
    let is_known =
        robot.find_joint(name).is_some() || ["x", "y", "z", "roll", "pitch", "yaw"].contains(&name);
    if !is_known {
        return unknown(name, name, robot);
    }
    Diagnostic::error("measurements::unit", format!("column \"{name}\" does not say its unit"))
        .with_help("units are in the names: _rad or _deg for an angle, _m or _mm for a length")
}

fn unknown(name: &str, stem: &str, robot: &Robot) -> Diagnostic {
    if name.contains([';', '\t']) {
        let message = format!("column \"{name}\" holds a semicolon or a tab");
        return Diagnostic::error("measurements::unknown_column", message)
            .with_help("columns are divided by commas, and decimals are written with a point");
    }
    let joints: Vec<&str> = robot.movable_joint_names().collect();
    let known = joints.into_iter().chain(["x", "y", "z", "qw", "qx", "qy", "qz", "roll", "pitch", "yaw"]);
    let message =
        format!("column \"{name}\" is no joint of robot \"{}\" and no measured quantity", robot.name());
    Diagnostic::error("measurements::unknown_column", message).with_help(known_names(
        stem,
        "columns (with _rad, _deg, _m or _mm)",
        known.collect::<Vec<_>>(),
    ))
}
