//! The answer of a check whose joints are called or counted otherwise in the other description.

use congruent_agreement::compare::Agreement;
use congruent_input::display::listed;
use congruent_kinematics::PoseError;

use super::{
    cause_in_words::{at_most, cause, few_or_number, largest},
    dynamics_in_words::other_torques,
    mapped_joints::mapped_joints,
    reported_mapping::ReportedMapping,
    robot_check::RobotCheck,
};

/// Joints that are called or counted otherwise, or that only one description has, if nothing declares it.
pub(super) fn after_mapping(check: &RobotCheck) -> Option<(String, String)> {
    let against = check.against.as_ref()?;
    let mapping = against.mapping.as_ref().filter(|mapping| !mapping.is_declared)?;
    let as_written = mapping.as_written.map_or_else(String::new, |error| {
        format!("; at the same joint values poses differ by up to {}", largest(error))
    });
    let joints = mapped_joints(mapping) + &as_written;
    let agrees = mapping.verdict == Some(Agreement::Agree);
    let worst = mapping.worst.map_or_else(
        || "poses were not compared".to_owned(),
        |worst| match worst {
            worst if worst == PoseError::default() => "poses are equal".to_owned(),
            worst if worst.is_within(&check.geometry.tolerance) => {
                format!("poses agree ({})", at_most(worst))
            }
            worst if agrees => format!("poses agree within the digits written ({})", largest(worst)),
            worst => format!("poses still differ ({})", largest(worst)),
        },
    );
    if !against.is_equal_after_mapping() {
        let cause = check.diagnosis().map_or_else(String::new, |diagnosis| format!(". {}", cause(diagnosis)));
        let torques = other_torques(check);
        let details = format!(": {joints}; in the same variables {worst}{cause}{torques}");
        return Some(("DIFFERENT".to_owned(), details));
    }
    if !mapping.left_out_in_chain.is_empty() {
        let differ = other_torques(check);
        return Some(other_chain_in_part(mapping, &joints, &(worst + &differ)));
    }
    let (where_compared, declare) = match mapping.all_of_alike() {
        Some(all) => (format!("IN {} OF {all} JOINTS", mapping.joints.len()), LEFT_OUT),
        None if mapping.alone().iter().any(|alone| !alone.is_empty()) => (
            format!("IN {} OF {} JOINTS AFTER MAPPING", mapping.joints.len(), mapping.all_joints()),
            "[mapping]",
        ),
        None => ("AFTER MAPPING".to_owned(), "[mapping]"),
    };
    let (answer, differ) = match check.all_dynamics().find(|report| !report.agrees()) {
        None => (format!("EQUAL {where_compared}"), String::new()),
        Some(report) if report.has_same_torques() => {
            let limits = check.limits(report);
            (format!("EQUAL {where_compared}, DIFFERENT JOINT LIMITS"), format!("; limits differ{limits}"))
        }
        Some(report) => (
            format!("SAME GEOMETRY {where_compared}, DIFFERENT DYNAMICS"),
            format!("; torques differ: {}{}", check.cause_of_torques(report), check.other_limits(report)),
        ),
    };
    let details = format!(": {joints}; in the same variables {worst}{differ}");
    Some((answer, to_declare(&details, declare)))
}

/// A joint between base and tip that moves in one file alone: another chain, even if the rest agrees.
fn other_chain_in_part(mapping: &ReportedMapping, joints: &str, worst: &str) -> (String, String) {
    let rest = match &mapping.held_at_zero[..] {
        [] => format!("the {} joints that it does not carry: {worst}", mapping.compared_joints()),
        held => format!("with {} at 0, {worst}", few_or_number(held, "joint")),
    };
    let details = format!(": {joints}, between base and tip; {rest}");
    ("DIFFERENT JOINTS".to_owned(), to_declare(&details, LEFT_OUT))
}

/// What a joint that moves in one file alone is declared as.
const LEFT_OUT: &str = "left_out in [mapping]";

/// The details with what to declare if they are meant.
fn to_declare(details: &str, what: &str) -> String {
    // A question has its mark already.
    let stop = if details.ends_with('?') { "" } else { "." };
    format!("{details}{stop} Declare {what} if this is meant")
}

/// Which joints of a mapping are compared, and at which position of the others.
pub(super) fn which_joints(mapping: &ReportedMapping) -> String {
    let behind: Vec<&str> = mapping.free_in_chain().map(|of| of.joint.as_str()).collect();
    match (&mapping.held_at_zero[..], &behind[..]) {
        ([], []) => "those of both files".to_owned(),
        (held, []) => format!("those of both files, with {} at 0", few_or_number(held, "joint")),
        (_, behind) => format!("none behind {}, left out by [mapping]", listed(behind)),
    }
}
