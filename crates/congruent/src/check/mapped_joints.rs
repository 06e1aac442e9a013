//! Joints that are called or counted otherwise in another description, in words.

use congruent_input::display::{angle, counted, listed};

use super::{
    cause_in_words::place,
    reported_mapping::{ReportedEnd, ReportedJoint, ReportedMapping},
};

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
        ("the opposite direction", those(&|of| of.sign < 0)),
        ("another zero", those(&|of| of.offset != 0.0)),
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
        let what = listed(&what);
        words.push(match joints[..] {
            _ if joints.len() == all => format!("all {all} joints have {what}"),
            [only] => format!("{only} has {what}{}", line_of(mapping, only)),
            [_, _] => format!("{} have {what}", listed(&joints)),
            _ => format!("{} of {all} joints have {what}", joints.len()),
        });
    }
    let [own, there] = mapping.alone();
    let [in_own, in_other] = [0, 1].map(|at| format!("in {} alone", mapping.names[at]));
    for (what, names) in [("elsewhere on the robot", mapping.elsewhere()), (&in_own, own), (&in_other, there)]
    {
        match names[..] {
            [] => {}
            [only] => words.push(format!("{only} moves {what}")),
            [_, _] => words.push(format!("{} move {what}", listed(&names))),
            _ => words.push(format!("{} move {what}", counted(names.len(), "joint"))),
        }
    }
    if let Some(turn_rad) = mapping.turn_of_base_rad() {
        words.push(format!("the base is turned by {}", angle(turn_rad)));
    }
    if words.is_empty() {
        words.push("the root frames differ".to_owned());
    }
    words.join(", ")
}

/// The line of the axis, or of the origin, of a joint with another variable.
fn line_of(mapping: &ReportedMapping, joint: &str) -> String {
    let line = mapping.joints.iter().find(|of| of.joint == joint).and_then(|of| of.line);
    place(mapping.file.as_deref(), line)
}

/// Lengths along the axes of last joints that are not compared, in words.
pub(super) fn ends_not_compared(mapping: &ReportedMapping) -> Option<String> {
    let ends: Vec<String> = mapping.ends_in_other_frames.iter().map(ReportedEnd::sentence).collect();
    (!ends.is_empty()).then(|| format!("not compared: {}", ends.join(", ")))
}
