//! A number for all joints, or numbers by joint, as one for each movable joint.

use congruent_description::{Diagnostic, Robot, known_names};

use crate::scenario::{FilePlace, JointNumbers, OTHERS, Range, mark};

/// What the numbers of one key are.
#[derive(Debug, Clone, Copy)]
pub(super) struct NumberRule<'a> {
    /// What one of them is, in messages.
    pub(super) what: &'a str,
    /// What each must be.
    pub(super) range: Range,
    /// The number of a joint that a table does not name, if it has no `others`; `None` refuses such a table.
    pub(super) unnamed: Option<f64>,
}

/// One number for each movable joint; those of mimic joints are zero, as they have no actuator of their own.
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
    let by_joint = match numbers {
        JointNumbers::All(number) => {
            in_range(*number, place).map_err(|error| vec![error])?;
            return Ok(joints().map(|joint| if joint.mimic.is_some() { 0.0 } else { *number }).collect());
        }
        JointNumbers::ByJoint(by_joint) => by_joint,
    };
    let mut errors = Vec::new();
    for (name, &number) in by_joint {
        let named = if name == OTHERS { Ok(()) } else { check_name(robot, name) };
        errors.extend(named.map_err(|error| mark(error, place.key_span(name))).err());
        errors.extend(in_range(number, place.key(name)).err());
    }
    let others = by_joint.get(OTHERS).copied().or(rule.unnamed);
    let mut resolved = Vec::with_capacity(robot.dof());
    for joint in joints() {
        let number = by_joint.get(&joint.name).copied().or(others);
        if number.is_none() && joint.mimic.is_none() {
            let message = format!("joint \"{}\" has no {}", joint.name, rule.what);
            let error = Diagnostic::error("scenario::joint_left_out", message);
            errors.push(
                place.mark(error.with_help("name it, or give `others = ...` for all that are not named")),
            );
        }
        resolved.push(if joint.mimic.is_some() { 0.0 } else { number.unwrap_or(0.0) });
    }
    if errors.is_empty() { Ok(resolved) } else { Err(errors) }
}

/// Whether a joint of this name has an actuator.
fn check_name(robot: &Robot, name: &str) -> Result<(), Diagnostic> {
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
    match joint.mimic {
        Some(mimic) => {
            let master = &robot.joint(mimic.master).name;
            let message = format!("joint \"{name}\" mimics \"{master}\" and has no actuator of its own");
            Err(Diagnostic::error("scenario::mimic_joint", message)
                .with_help("give the number of the joint that it mimics"))
        }
        None => Ok(()),
    }
}
