//! Joints that are called or counted otherwise in another description, in words.

use congruent_input::display::{counted, listed};

use super::mapped::{ReportedJoint, ReportedMapping};

/// Whether a joint is of a kind.
type IsSuch = fn(&ReportedJoint) -> bool;

/// What differs in joints, in words: `2 of 6 joints have other zeros (joint_2, joint_3)`.
pub(super) fn mapped_joints(mapping: &ReportedMapping) -> String {
    let all = mapping.joints.len();
    let kinds: [(&str, IsSuch); 3] = [
        ("another name", |of| of.joint != of.other),
        ("the opposite direction", |of| of.sign < 0),
        ("another zero", |of| of.offset != 0.0),
    ];
    let mut words = Vec::new();
    for (what, is_such) in kinds {
        let names: Vec<&str> =
            mapping.joints.iter().filter(|of| is_such(of)).map(|of| of.joint.as_str()).collect();
        match names.len() {
            0 => {}
            count if count == all => words.push(format!("all {all} joints have {what}")),
            1 | 2 => words.push(format!(
                "{} {} {what}",
                listed(&names),
                if names.len() == 1 { "has" } else { "have" }
            )),
            count => words.push(format!("{count} of {all} joints have {what}")),
        }
    }
    let alone = mapping.left_out.len() + mapping.other_left_out.len();
    if alone > 0 {
        words.push(format!("{} in one file alone", counted(alone, "joint")));
    }
    if words.is_empty() {
        words.push("the root frames differ".to_owned());
    }
    words.join(", ")
}
