//! Joint positions by name, in the unit that the key names.

use std::{collections::BTreeMap, ops::Range};

use congruent_description::{Diagnostic, Joint, JointIndex, JointKind, Robot, known_names, units::Unit};
use toml::Spanned;

use super::number::Finite;

/// Positions under one key, as written.
pub(crate) type WrittenJoints = BTreeMap<Spanned<String>, Spanned<Finite>>;

/// The four keys under which positions may be given: angles for turning joints, lengths for
/// sliding ones.
#[derive(Debug, Clone, Default)]
pub(crate) struct JointValues {
    pub(crate) deg: WrittenJoints,
    pub(crate) rad: WrittenJoints,
    pub(crate) m: WrittenJoints,
    pub(crate) mm: WrittenJoints,
}

/// One joint position in SI units, with its place in the text.
#[derive(Debug, Clone)]
pub(crate) struct JointValue {
    pub(crate) joint: JointIndex,
    /// rad or m.
    pub(crate) value: f64,
    pub(crate) span: Range<usize>,
}

/// A figure of a file in the unit of the program.
type ToSi = fn(Unit, f64) -> f64;

impl JointValue {
    /// What is wrong where the position is beyond the joint's limits; `what` it is, in words.
    pub(crate) fn beyond_limits(&self, robot: &Robot, what: &str) -> Option<String> {
        let joint = robot.joint(self.joint);
        let (lower, upper) = joint.position_range()?;
        let (name, value, unit) = (&joint.name, self.value, joint.kind.unit());
        (!(lower..=upper).contains(&value))
            .then(|| format!("joint \"{name}\": {what} {value} {unit} is outside [{lower}, {upper}]"))
    }
}

impl JointValues {
    /// Resolves names and units.
    ///
    /// # Errors
    /// Every unknown, repeated, fixed or mimicking joint and every value in the wrong kind of unit.
    pub(crate) fn resolve(&self, robot: &Robot) -> Result<Vec<JointValue>, Vec<Diagnostic>> {
        let mut values: Vec<JointValue> = Vec::new();
        let mut errors = Vec::new();
        let groups: [(&WrittenJoints, Unit, ToSi); 4] = [
            (&self.deg, Unit::Angle, Unit::convert),
            (&self.rad, Unit::Angle, |_, rad| rad),
            (&self.m, Unit::Length, |_, m| m),
            (&self.mm, Unit::Length, Unit::convert),
        ];
        for (written, unit, to_si) in groups {
            for (name, value) in written {
                match joint_named(robot, name, unit) {
                    Ok(joint) if values.iter().any(|known| known.joint == joint) => {
                        errors.push(repeated(name));
                    }
                    Ok(joint) => values.push(JointValue {
                        joint,
                        value: to_si(unit, value.get_ref().get()),
                        span: name.span().start..value.span().end,
                    }),
                    Err(error) => errors.push(error),
                }
            }
        }
        if errors.is_empty() { Ok(values) } else { Err(errors) }
    }
}

fn repeated(name: &Spanned<String>) -> Diagnostic {
    let message = format!("joint \"{}\" is given twice", name.get_ref());
    Diagnostic::error("scenario::joint_twice", message).at(name.span())
}

fn joint_named(robot: &Robot, name: &Spanned<String>, unit: Unit) -> Result<JointIndex, Diagnostic> {
    let text = name.get_ref();
    let Some(index) = robot.find_joint(text).filter(|&joint| robot.coordinate(joint).is_some()) else {
        let joints = robot.movable_joint_names();
        let message = format!("robot \"{}\" has no moving joint \"{text}\"", robot.name());
        return Err(Diagnostic::error("scenario::unknown_joint", message)
            .with_help(known_names(text, "joints", joints))
            .at(name.span()));
    };
    let joint = robot.joint(index);
    if let Some(mimic) = joint.mimic {
        let message = format!("joint \"{text}\" mimics \"{}\"", robot.joint(mimic.master).name);
        return Err(Diagnostic::error("scenario::mimic_joint", message)
            .with_help("give the position of the joint that it mimics")
            .at(name.span()));
    }
    if joint.kind.is_angular() != matches!(unit, Unit::Angle) {
        return Err(wrong_unit(joint).at(name.span()));
    }
    Ok(index)
}

fn wrong_unit(joint: &Joint) -> Diagnostic {
    let (moves, keys) = match joint.kind {
        JointKind::Prismatic => ("slides", "`_m` or `_mm`"),
        _ => ("turns", "`_deg` or `_rad`"),
    };
    Diagnostic::error("scenario::joint_unit", format!("joint \"{}\" {moves}", joint.name))
        .with_help(format!("give its position under a key that ends in {keys}"))
}
