//! The comparisons of dynamics: the result, its causes with their lines, and what else differs.

use congruent_dynamics_agreement::{
    DynamicsExplanation, DynamicsReport, DynamicsVerdict, ParameterDifference,
};
use congruent_input::display::number;
use maud::{Markup, html};

use super::checked_robot::CheckedRobot;
use crate::parts::{BadgeKind, Pointer, badge, changed, value};

/// Values of a cause that are shown; the report has all.
const SHOWN: usize = 10;

/// The section; nothing if no dynamics was compared.
pub(super) fn dynamics(robot: &CheckedRobot<'_>, at: &Pointer) -> Markup {
    html! {
        @if !robot.dynamics.is_empty() {
            section {
                // The physics is built from the URDF: it is no second description of the dynamics.
                @let is_own = robot.dynamics.iter().all(|report| report.is_of_physics());
                h2 { @if is_own { "Self-test of the physics" } @else { "Dynamics" } }
                @for (index, report) in robot.dynamics.iter().enumerate() {
                    @let at = match index {
                        0 => at.key("dynamics"),
                        further => at.key("other_dynamics").key(further - 1),
                    };
                    (compared(robot, report, &at))
                }
            }
        }
    }
}

/// The comparisons whose causes answer why the robots differ, since their poses do not.
fn decisive<'r>(robot: &'r CheckedRobot<'_>) -> impl Iterator<Item = &'r DynamicsReport> {
    let decide = !robot.geometry.poses_disagree();
    robot.dynamics.iter().copied().filter(move |report| decide && !report.agrees())
}

/// The causes of a difference that is of dynamics alone; `None` if none is known.
pub(super) fn causes(robot: &CheckedRobot<'_>) -> Option<Markup> {
    let is_known = |report: &DynamicsReport| !report.explanations.is_empty() || report.has_other_limits();
    decisive(robot).any(is_known).then(|| {
        html! {
            @for report in decisive(robot) {
                @let files = files(robot, report);
                @for explanation in &report.explanations { (explained(explanation, files)) }
                @for limit in report.limits.iter().filter(|limit| limit.decides) {
                    p.fault { (files.map_or_else(|| limit.sentence(), |files| limit.sentence_in(files))) }
                    (changed(&limit.changes, None))
                }
            }
        }
    })
}

/// The two files of a comparison of which neither is known to be right.
fn files<'r>(robot: &CheckedRobot<'_>, report: &'r DynamicsReport) -> Option<[&'r str; 2]> {
    report.sides.files().filter(|_| robot.other.is_some())
}

fn compared(robot: &CheckedRobot<'_>, report: &DynamicsReport, at: &Pointer) -> Markup {
    let is_answered = decisive(robot).any(|other| std::ptr::eq(other, report));
    let (outcome, word) = match (report.agrees(), report.has_same_torques(), report.verdict) {
        (true, _, DynamicsVerdict::NotCompared) => (BadgeKind::Unclear, "not compared"),
        (true, ..) => (BadgeKind::Good, "agree"),
        (false, true, _) => (BadgeKind::Bad, "joint limits disagree"),
        (false, false, _) => (BadgeKind::Bad, "disagree"),
    };
    let percent = format!("{} %", number(100.0 * report.difference_relative));
    html! {
        div.card.(outcome.class()) {
            h3 { (badge(outcome, word)) " " (sides(report)) }
            p {
                (report.headline().trim_end_matches(':')) " (difference of torque "
                (value(&at.key("difference_relative"), report.difference_relative, &percent)) ")"
            }
            // What answers the question of the page is above.
            @if !is_answered { @for explanation in &report.explanations { (explained(explanation, files(robot, report))) } }
            @let others = others(report, files(robot, report));
            @if !others.is_empty() { ul { @for sentence in &others { li { (sentence) } } } }
            @if !is_answered {
                @for limit in report.limits.iter().filter(|limit| limit.decides) { (changed(&limit.changes, None)) }
            }
        }
    }
}

/// What was compared; the physics is no second description, but is built from the URDF.
fn sides(report: &DynamicsReport) -> String {
    let (candidate, reference) = (&report.sides.candidate, &report.sides.reference);
    if report.is_of_physics() {
        format!("the physics against {candidate}, from which it is built")
    } else {
        format!("{candidate} against {reference}")
    }
}

/// A cause, the values that it corrects with their lines, and what to write.
fn explained(explanation: &DynamicsExplanation, files: Option<[&str; 2]>) -> Markup {
    let place = |parameter: &ParameterDifference| match (&explanation.file, parameter.line) {
        (Some(file), Some(line)) => format!("{file}:{line}: "),
        _ => String::new(),
    };
    let remark = |parameter: &ParameterDifference| {
        let remark = parameter.unit_remark().filter(|_| explanation.cause.is_of_free_values());
        remark.map_or_else(String::new, |remark| format!(": {remark}"))
    };
    // The value to write here would be the wrong one.
    let is_other_wrong =
        files.is_some() && explanation.parameters.iter().any(ParameterDifference::is_reference_in_other_unit);
    html! {
        p.fault { (explanation.sentence()) }
        ul {
            @for parameter in explanation.parameters.iter().take(SHOWN) {
                li {
                    @if let Some(files) = files { (parameter.sentence_in(files)) }
                    @else { code { (place(parameter)) } (parameter.sentence()) }
                    (remark(parameter))
                }
            }
        }
        @if !is_other_wrong { (changed(&explanation.changes, None)) }
    }
}

/// Sentences beside the causes: what is indistinguishable, not identifiable, or a limit that differs.
fn others(report: &DynamicsReport, files: Option<[&str; 2]>) -> Vec<String> {
    let limits = report.limit_sentences(files).into_iter().chain(report.one_sided_limit_sentences());
    let torques = if report.has_same_torques() { Vec::new() } else { report.invariant_sentences() };
    let worst =
        report.worst_gravity().map(|worst| format!("largest gravity torque difference {}", worst.sentence()));
    limits
        .chain(report.not_stated_sentence())
        .chain(report.armature_sentence())
        .chain(torques)
        .chain(report.hidden_sentences(files).into_iter().take(SHOWN))
        .chain(worst)
        .collect()
}
