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
                h2 { "Dynamics" }
                @for (index, report) in robot.dynamics.iter().enumerate() {
                    @let at = match index {
                        0 => at.key("dynamics"),
                        further => at.key("other_dynamics").key(further - 1),
                    };
                    (compared(report, &at))
                }
            }
        }
    }
}

fn compared(report: &DynamicsReport, at: &Pointer) -> Markup {
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
            @for explanation in &report.explanations { (explained(explanation)) }
            @let others = others(report);
            @if !others.is_empty() { ul { @for sentence in &others { li { (sentence) } } } }
            @for limit in report.limits.iter().filter(|limit| limit.decides) { (changed(&limit.changes, None)) }
        }
    }
}

/// What was compared; the physics is no second description, but is built from the URDF.
fn sides(report: &DynamicsReport) -> String {
    let (candidate, reference) = (&report.sides.candidate, &report.sides.reference);
    match reference.as_str() {
        "physics" => format!("{candidate} against the program's own physics"),
        _ => format!("{candidate} against {reference}"),
    }
}

/// A cause, the values that it corrects with their lines, and what to write.
fn explained(explanation: &DynamicsExplanation) -> Markup {
    let place = |parameter: &ParameterDifference| match (&explanation.file, parameter.line) {
        (Some(file), Some(line)) => format!("{file}:{line}: "),
        _ => String::new(),
    };
    html! {
        p.fault { (explanation.sentence()) }
        ul { @for parameter in explanation.parameters.iter().take(SHOWN) { li { code { (place(parameter)) } (parameter.sentence()) } } }
        (changed(&explanation.changes, None))
    }
}

/// Sentences beside the causes: what is indistinguishable, not identifiable, or a limit that differs.
fn others(report: &DynamicsReport) -> Vec<String> {
    let limits = report.limits.iter().map(congruent_dynamics_agreement::LimitDifference::sentence);
    let torques = report.invariants.iter().filter(|_| !report.has_same_torques());
    let torques = torques.flat_map(congruent_dynamics_agreement::Invariants::sentences);
    let worst =
        report.worst_gravity().map(|worst| format!("largest gravity torque difference {}", worst.sentence()));
    limits
        .chain(report.not_stated_sentence())
        .chain(torques)
        .chain(report.hidden_sentences().into_iter().take(SHOWN))
        .chain(worst)
        .collect()
}
