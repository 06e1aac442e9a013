//! A number for all joints, or numbers by joint, as one for each movable joint.

use congruent_description::{Joint, Robot};
use congruent_input::{Diagnostic, Findings, known_names};
use congruent_scenario::{FilePlace, JointNumbers, OTHERS, Range, mark};

use crate::codes;

/// Rules for the numbers of one key.
#[derive(Debug, Clone, Copy)]
pub(super) struct NumberRule<'a> {
    /// The key, as messages name it.
    pub(super) what: &'a str,
    /// Range that each number must be in.
    pub(super) range: Range,
    /// Value of joints that a table does not name, if it has no `others`.
    pub(super) unnamed: Unnamed<'a>,
    /// Whether the key applies to turning joints only (`true`), to sliding joints only (`false`), or to both (`None`).
    pub(super) of_angles: Option<bool>,
}

/// Value of joints that have no number of their own.
#[derive(Debug, Clone, Copy)]
pub(super) enum Unnamed<'a> {
    /// An error: each joint needs a number.
    Refused,
    /// The value is zero.
    Zero,
    /// The value of the robot's description, by coordinate.
    Described(&'a [f64]),
}

/// One number for each movable joint; those of mimic joints, which have no actuator of their own, cannot be given.
///
/// # Errors
/// Every unknown or mimic joint, every number out of range, and a table that omits joints that need a number.
pub(super) fn resolve(
    numbers: &JointNumbers,
    rule: NumberRule<'_>,
    place: FilePlace<'_>,
    robot: &Robot,
) -> Result<Vec<f64>, Findings> {
    let joints = || robot.movable_joints().iter().map(|&joint| robot.joint(joint));
    let in_range = |number: f64, place: FilePlace<'_>| {
        let message = format!("expected {}, found {number}", rule.range.words());
        let refused = || place.mark(Diagnostic::error(congruent_input::codes::toml::INVALID, message));
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
            // Checked first: `others` and a single number are for the joints that can have the key.
            _ if !rule.applies_to(joint) => None,
            JointNumbers::All(number) => Some(*number),
            // A joint's own number wins over `others`.
            JointNumbers::ByJoint(by_joint) => by_joint.get(&joint.name).or(by_joint.get(OTHERS)).copied(),
        };
        if number.is_none() && rule.applies_to(joint) && matches!(rule.unnamed, Unnamed::Refused) {
            let message = format!("joint \"{}\" has no {}", joint.name, rule.what);
            let help = "add the joint, or `others = ...` for all joints that are not named";
            errors.push(
                place.mark(Diagnostic::error(codes::scenario::JOINT_LEFT_OUT, message).with_help(help)),
            );
        }
        let unnamed =
            if let Unnamed::Described(described) = rule.unnamed { described[coordinate] } else { 0.0 };
        resolved.push(number.unwrap_or(unnamed));
    }
    if errors.is_empty() { Ok(resolved) } else { Err(errors.into()) }
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
        return Err(Diagnostic::error(congruent_motion::codes::scenario::UNKNOWN_JOINT, message)
            .with_help(known_names(name, "joints", names.chain([OTHERS]))));
    };
    if let Some(mimic) = joint.mimic {
        let master = &robot.joint(mimic.master).name;
        let message = format!("joint \"{name}\" mimics \"{master}\" and has no actuator of its own");
        return Err(Diagnostic::error(congruent_motion::codes::scenario::MIMIC_JOINT, message)
            .with_help(format!("give the value for joint \"{master}\" instead")));
    }
    if rule.applies_to(joint) {
        return Ok(());
    }
    let message = format!(
        "joint \"{name}\" is {}: `{}` does not apply to this kind of joint",
        joint.kind.name(),
        rule.what
    );
    Err(Diagnostic::error(congruent_motion::codes::scenario::JOINT_UNIT, message).with_help(
        if joint.kind.is_angular() {
            "use the key in degrees or radians"
        } else {
            "use the key in millimetres or metres"
        },
    ))
}
