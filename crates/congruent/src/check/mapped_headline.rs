//! The first line of a check of two descriptions whose joints are called or counted otherwise.

use congruent_input::display::{counted, listed};

use super::{
    headline::{Headline, cause, largest, limits},
    mapped::{ReportedJoint, ReportedMapping},
    robot_check::RobotCheck,
};

/// Joints that are called or counted otherwise, or that only one description has, if nothing declares it.
pub(super) fn after_mapping(check: &RobotCheck) -> Option<Headline> {
    let against = check.against.as_ref()?;
    let mapping = against.mapping.as_ref().filter(|mapping| !mapping.is_declared)?;
    let joints = mapped_joints(mapping);
    let worst = mapping.worst.map_or_else(
        || "poses were not compared".to_owned(),
        |worst| {
            let words =
                if worst.is_within(&check.geometry.tolerance) { "poses agree" } else { "poses still differ" };
            format!("{words} ({})", largest(worst))
        },
    );
    if !against.is_equal_after_mapping(&check.geometry.tolerance) {
        let cause = check.diagnosis().map_or_else(String::new, |diagnosis| format!(". {}", cause(diagnosis)));
        return Some(Headline::new("DIFFERENT", format!(": {joints}; in the same variables {worst}{cause}")));
    }
    let torques = check.all_dynamics().find(|report| !report.agrees());
    let but = torques.map_or_else(String::new, |report| {
        let why = if report.has_same_torques() {
            limits(&report.limits)
        } else {
            format!(": {}", check.cause_of_torques(report))
        };
        format!(", but dynamics or limits differ{why}")
    });
    let details =
        format!(": {joints}; in the same variables {worst}{but}. Declare [mapping] if this is meant");
    Some(Headline::new("EQUAL AFTER MAPPING", details))
}

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
