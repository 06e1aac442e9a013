//! The answer of a check against a revision: what the change does, as the first line and as a test case.

use congruent_agreement::{SourcePair, compare::Agreement};
use congruent_dynamics_agreement::DynamicsVerdict;
use congruent_results::report::{CasePlace, ChangeSince, Reason, TestCase, TestResult};

use super::{
    cause_in_words::{cause, largest, places},
    change::{RevisionChange, is_of_revision},
    mapped_joints::mapped_joints,
    reported_mapping::ReportedMapping,
    robot_check::RobotCheck,
};

/// The answer if the change does anything that counts.
const CHANGED: &str = "CHANGED";

/// The answer of a check against a revision in capitals, and what follows it; `None` if what disagrees is not the revision.
pub(super) fn answer_of_change(check: &RobotCheck) -> Option<(&'static str, String)> {
    let change = check.change.as_ref()?;
    let since = format!("since {}", change.revision);
    let parts = parts(check, change);
    if check.geometry.verdict == Agreement::Disagree {
        let of_poses = check.geometry.diagnoses.iter().find(|of| of.name == SourcePair::UrdfOther);
        let known = of_poses.filter(|of| of.named_cause().is_some());
        let cause = known.map_or_else(String::new, |of| format!(". {}", cause(of)));
        let details = format!(" {since}: {}{cause}", parts.join("; "));
        return (!parts.is_empty()).then_some((CHANGED, details));
    }
    let compared = compared(check);
    let details = if parts.is_empty() {
        format!(" {since}: {compared} are the same")
    } else {
        format!(" {since} in {compared}; {}", parts.join("; "))
    };
    Some(("UNCHANGED", details))
}

/// What the two revisions are compared in.
fn compared(check: &RobotCheck) -> &'static str {
    let has_dynamics = check.dynamics_of_descriptions().any(|of| of.verdict != DynamicsVerdict::NotCompared);
    if has_dynamics { "poses, torques and limits" } else { "poses" }
}

/// The change for CI: what changes, and at which lines of today's files.
pub(super) fn change_since(check: &RobotCheck) -> Option<ChangeSince> {
    let change = check.change.as_ref()?;
    let parts = parts(check, change);
    let is_changed = !parts.is_empty();
    let compared = compared(check);
    let sentence = match (is_changed, check.geometry.verdict) {
        (false, _) => format!("no change in {compared}"),
        (true, Agreement::Disagree) => parts.join("; "),
        (true, _) => format!("{}; {compared} are the same", parts.join("; ")),
    };
    let of_poses = check.geometry.diagnoses.iter().find(|of| of.name == SourcePair::UrdfOther);
    let mut places = of_poses.map(places).unwrap_or_default();
    for report in check.dynamics_of_descriptions().filter(|of| is_of_revision(of)) {
        let Some(files) = report.sides.files() else { continue };
        let parameters = report.explanations.iter().flat_map(|of| &of.parameters);
        let parameters = parameters.chain(&report.hidden_differences);
        let limits = report.limits.iter().map(|of| (of.line, of.sentence_in(files)));
        let lines = parameters.map(|of| (of.line, of.sentence_in(files))).chain(limits);
        places.extend(
            lines.filter_map(|(line, what)| Some((CasePlace::if_known(Some(files[0]), line)?, what))),
        );
    }
    Some(ChangeSince { revision: change.revision.clone(), sentence, is_changed, places })
}

/// The answer as a test case of the JUnit file.
pub(super) fn change_case(check: &RobotCheck) -> Option<TestCase> {
    let (answer, details) = answer_of_change(check)?;
    let output = answer.to_owned() + &details;
    let result = if answer == CHANGED {
        TestResult::Changed(Reason { kind: "changed".to_owned(), message: output.clone() })
    } else {
        TestResult::Passed
    };
    let name = format!("change since {}", check.change.as_ref()?.revision);
    Some(TestCase { name, result, output, place: None, further: Vec::new() })
}

/// What the change does, in words; empty if nothing.
fn parts(check: &RobotCheck, change: &RevisionChange) -> Vec<String> {
    let mut parts = Vec::new();
    let mapping = check.against.as_ref().and_then(|against| against.mapping.as_ref());
    let is_renamed =
        |of: &&ReportedMapping| of.joints.iter().any(|of| of.joint != of.other || !of.has_same_variable());
    parts.extend(mapping.filter(is_renamed).map(mapped_joints));
    let of_poses = check.geometry.comparisons.iter().find(|of| of.name == SourcePair::UrdfOther);
    if change.is_moved(&check.geometry.tolerance) {
        parts.push(format!("moves {} by up to {}", change.link, largest(change.moved)));
    } else if let Some(of) = of_poses.filter(|of| of.verdict == Agreement::Disagree && mapping.is_none()) {
        let by = largest(of.worst.error);
        parts.push(format!("moves {} by up to {by}, and not the tip", of.worst.link));
    }
    parts.extend(change.parts());
    if parts.is_empty() {
        let torques = check.dynamics_of_descriptions().find(|report| !report.has_same_torques());
        parts.extend(torques.map(|report| check.cause_of_torques(report)));
    }
    parts
}
