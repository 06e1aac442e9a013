//! A number for all joints, or numbers by joint, as one for each movable joint.

use congruent_description::{Diagnostic, Joint, Robot, known_names};

use crate::scenario::{FilePlace, JointNumbers, OTHERS, Range, mark};

/// What the numbers of one key are.
#[derive(Debug, Clone, Copy)]
pub(super) struct NumberRule<'a> {
    /// What one of them is, in messages.
    pub(super) what: &'a str,
    /// What each must be.
    pub(super) range: Range,
    /// What holds for the joints that a table does not name, if it has no `others`.
    pub(super) unnamed: Unnamed<'a>,
    /// Only joints that turn have one, or only joints that slide; `None` for both.
    pub(super) of_angles: Option<bool>,
}

/// What holds for joints that have no number.
#[derive(Debug, Clone, Copy)]
pub(super) enum Unnamed<'a> {
    /// Each needs one.
    Refused,
    /// Zero.
    Zero,
    /// What the description says.
    Described(&'a [f64]),
}

/// One number for each movable joint; those of mimic joints, which have no actuator of their own, cannot be given.
///
/// # Errors
/// Every unknown or mimic joint, every number out of range, and a table that leaves joints out that need a number.
pub(super) fn resolve(
    numbers: &JointNumbers,
    rule: NumberRule<'_>,
    place: FilePlace<'_>,
    robot: &Robot,
) -> Result<Vec<f64>, Vec<Diagnostic>> {
    let joints = || robot.movable_joints().iter().map(|&joint| robot.joint(joint));
    let in_range = |number: f64, place: FilePlace<'_>| {
        let message = format!("expected {}, found {number}", rule.range.words());
        let refused = || place.mark(Diagnostic::error("toml::invalid", message));
        if rule.range.contains(number) { Ok(()) } else { Err(refused()) }
    };
    let mut errors = Vec::new();
    match numbers {
        JointNumbers::All(number) => errors.extend(in_range(*number, place).err()),
        JointNumbers::ByJoint(by_joint) => {
            for (name, &number) in by_joint {
                let named = if name == OTHERS { Ok(()) } else { check_name(robot, name, rule) };
                errors.extend(named.map_err(|error| mark(error, place.key_span(name))).err());
                errors.extend(in_range(number, place.key(name)).err());
            }
        }
    }
    let mut resolved = Vec::with_capacity(robot.dof());
    for (coordinate, joint) in joints().enumerate() {
        let number = match numbers {
            _ if !rule.applies_to(joint) => None,
            JointNumbers::All(number) => Some(*number),
            JointNumbers::ByJoint(by_joint) => by_joint.get(&joint.name).or(by_joint.get(OTHERS)).copied(),
        };
        if number.is_none() && rule.applies_to(joint) && matches!(rule.unnamed, Unnamed::Refused) {
            let message = format!("joint \"{}\" has no {}", joint.name, rule.what);
            let help = "name it, or give `others = ...` for all that are not named";
            errors.push(place.mark(Diagnostic::error("scenario::joint_left_out", message).with_help(help)));
        }
        let unnamed =
            if let Unnamed::Described(described) = rule.unnamed { described[coordinate] } else { 0.0 };
        resolved.push(number.unwrap_or(unnamed));
    }
    if errors.is_empty() { Ok(resolved) } else { Err(errors) }
}

impl NumberRule<'_> {
    fn applies_to(&self, joint: &Joint) -> bool {
        joint.mimic.is_none() && self.of_angles.is_none_or(|of_angles| of_angles == joint.kind.is_angular())
    }
}

/// Whether a joint of this name has an actuator.
fn check_name(robot: &Robot, name: &str, rule: NumberRule<'_>) -> Result<(), Diagnostic> {
    let joint = robot.find_joint(name).filter(|&joint| robot.coordinate(joint).is_some());
    let Some(joint) = joint.map(|joint| robot.joint(joint)) else {
        let message = format!("robot \"{}\" has no moving joint \"{name}\"", robot.name());
        let names = robot.movable_joint_names();
        return Err(Diagnostic::error("scenario::unknown_joint", message).with_help(known_names(
            name,
            "joints",
            names.chain([OTHERS]),
        )));
    };
    if let Some(mimic) = joint.mimic {
        let master = &robot.joint(mimic.master).name;
        let message = format!("joint \"{name}\" mimics \"{master}\" and has no actuator of its own");
        return Err(Diagnostic::error("scenario::mimic_joint", message)
            .with_help("give the number of the joint that it mimics"));
    }
    if rule.applies_to(joint) {
        return Ok(());
    }
    let message = format!("joint \"{name}\" is {}, `{}` is for others", joint.kind.name(), rule.what);
    Err(Diagnostic::error("scenario::joint_unit", message).with_help("give it under the key of its unit"))
}
