//! Joints that are called or counted otherwise in another description, in words.

use congruent_input::display::{angle, counted, listed};

use super::{
    cause_in_words::place,
    reported_mapping::{ReportedEnd, ReportedJoint, ReportedMapping},
};

const OTHER_DIRECTION: &str = "the opposite direction";
const OTHER_ZERO: &str = "another zero";

/// What differs in joints, in words: `2 of 6 joints have other zeros (joint_2, joint_3)`.
pub(super) fn mapped_joints(mapping: &ReportedMapping) -> String {
    let all = mapping.joints.len();
    let those = |is_such: &dyn Fn(&ReportedJoint) -> bool| -> Vec<&str> {
        mapping.joints.iter().filter(|of| is_such(of)).map(|of| of.joint.as_str()).collect()
    };
    // A name that a joint of the robot has as well is no other name: it belongs to another joint there.
    let names = those(&|_| true);
    let is_known = |of: &ReportedJoint| names.contains(&of.other.as_str());
    let exchanged = those(&|of| of.joint != of.other && is_known(of));
    let mut words = Vec::new();
    if !exchanged.is_empty() {
        words.push(format!("the names of joints {} are exchanged", listed(&exchanged)));
    }
    let kinds = [
        ("another name", those(&|of| of.joint != of.other && !is_known(of))),
        (OTHER_DIRECTION, those(&|of| of.sign < 0)),
        (OTHER_ZERO, those(&|of| of.offset != 0.0)),
    ];
    // What differs in the same joints is said of them once.
    let mut differing: Vec<(Vec<&str>, Vec<&str>)> = Vec::new();
    for (names, joints) in kinds.into_iter().filter(|(_, joints)| !joints.is_empty()) {
        match differing.iter_mut().find(|(_, known)| *known == joints) {
            Some((what, _)) => what.push(names),
            None => differing.push((vec![names], joints)),
        }
    }
    for (what, joints) in differing {
        words.push(match joints[..] {
            _ if joints.len() == all => format!("all {all} joints have {}", listed(&what)),
            [only] => format!("{only} has {}", with_lines(mapping, only, &what)),
            [_, _] => format!("{} have {}", listed(&joints), listed(&what)),
            _ => format!("{} of {all} joints have {}", joints.len(), listed(&what)),
        });
    }
    let [own, there] = mapping.alone();
    let [in_own, in_other] = [0, 1].map(|at| format!("in {} alone", mapping.names[at]));
    for (what, names) in [("elsewhere on the robot", mapping.elsewhere()), (&in_own, own), (&in_other, there)]
    {
        let is_undeclared = |name: &&str| mapping.undeclared.iter().any(|of| of == name);
        let names: Vec<&str> = names.into_iter().filter(is_undeclared).collect();
        match names[..] {
            [] => {}
            [only] => words.push(format!("{only} moves {what}")),
            [_, _] => words.push(format!("{} move {what}", listed(&names))),
            _ => words.push(format!("{} move {what}", counted(names.len(), "joint"))),
        }
    }
    if let Some(turn_rad) = mapping.turn_of_base_rad() {
        let or_zero = mapping.turned_first_joint.as_ref().map_or_else(String::new, |(joint, line)| {
            format!(", or {joint} has {OTHER_ZERO}{}", place(mapping.file.as_deref(), *line))
        });
        words.push(format!("the base is turned by {}{or_zero}", angle(turn_rad)));
    }
    if words.is_empty() {
        words.push("the root frames differ".to_owned());
    }
    words.join(", ")
}

/// What differs in a joint, each with the line of its value: `the opposite direction (a.urdf:8) and another zero (a.urdf:7)`.
fn with_lines(mapping: &ReportedMapping, joint: &str, what: &[&str]) -> String {
    let of = mapping.joints.iter().find(|of| of.joint == joint);
    let line = |what: &str| match what {
        OTHER_DIRECTION => of.and_then(|of| of.axis_line),
        OTHER_ZERO => of.and_then(|of| of.origin_line),
        _ => None,
    };
    let in_line = |what: &&str| format!("{what}{}", place(mapping.file.as_deref(), line(what)));
    let in_lines: Vec<String> = what.iter().map(in_line).collect();
    listed(&in_lines.iter().map(String::as_str).collect::<Vec<_>>())
}

/// Lengths along the axes of last joints that are not compared, in words.
pub(super) fn ends_not_compared(mapping: &ReportedMapping) -> Option<String> {
    let ends: Vec<String> = mapping.ends_in_other_frames.iter().map(ReportedEnd::sentence).collect();
    (!ends.is_empty()).then(|| format!("not compared: {}", ends.join(", ")))
}
