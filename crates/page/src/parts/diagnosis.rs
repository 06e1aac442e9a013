//! Why two models differ: each fault at its lines of the file, what to write there, and the difference before and after.

use std::path::Path;

use congruent_agreement::report::{
    Fault, ReportedAlternative, ReportedCause, ReportedDiagnosis, ReportedStage,
};
use congruent_input::{
    Diagnostic,
    display::{angle, length, length_and_angle},
    portable_path,
};
use maud::{Markup, html};

use super::{
    lines::{changed, marked},
    value::{Pointer, value},
};

/// Causes that cannot be distinguished from the first and are shown; the report has all.
const SHOWN: usize = 6;

/// The first cause of a diagnosis and what cannot be distinguished from it; `at` is its place in the report.
pub(crate) fn diagnosis(diagnosis: &ReportedDiagnosis, at: &Pointer) -> Markup {
    let Some(first) = diagnosis.causes.first() else { return html! {} };
    let at_first = at.keys(&["causes", "0"]);
    let faults: Vec<&Fault> =
        if first.parts.is_empty() { vec![&first.fault] } else { first.parts.iter().collect() };
    // The same corrections found by another model are no other cause.
    let is_other = |other: &&ReportedAlternative| {
        let of_other = other.cause.faults();
        of_other.len() != faults.len() || !of_other.iter().all(|one| faults.iter().any(|of| is_same(one, of)))
    };
    let others: Vec<&ReportedAlternative> = diagnosis.indistinguishable.iter().filter(is_other).collect();
    html! {
        p { (summary(first, diagnosis.findings.len(), &at_first)) " (" (diagnosis.title) ")" }
        @for (index, (finding, fault)) in diagnosis.findings.iter().zip(&faults).enumerate() {
            div.card {
                (found(finding, fault))
                @if let Some(stage) = first.stages.get(index) { (stages(stage, &at_first.key("stages").key(index))) }
            }
        }
        @if let Some(corrected) = &diagnosis.corrected {
            details { summary { "the table of " (portable_path(Path::new(&corrected.file)).display()) ", corrected, to paste" } pre.paste { (corrected.table()) } }
        }
        @if !others.is_empty() {
            details {
                summary { "causes that cannot be distinguished from this one (" (others.len()) ")" }
                ul { @for other in others.iter().take(SHOWN) { (alternative(other)) } }
            }
        }
    }
}

/// Whether two faults are one: the same value of the same joint.
fn is_same(a: &Fault, b: &Fault) -> bool {
    a.joint == b.joint && a.parameter == b.parameter && a.cause == b.cause && a.suggestion == b.suggestion
}

/// How much of the difference is explained.
fn summary(first: &ReportedCause, count: usize, at: &Pointer) -> Markup {
    let causes = match count {
        0 => return html! { "No known cause explains the difference." },
        1 => "One cause explains".to_owned(),
        _ => format!("{count} causes together, the one with the largest effect first, explain"),
    };
    let residual = html! {
        (value(&at.key("residual_m"), first.residual_m, &length(first.residual_m)))
        " and " (value(&at.key("residual_rad"), first.residual_rad, &angle(first.residual_rad)))
    };
    html! {
        (causes)
        @if first.within_tolerance { " the difference; residual " (residual) "." }
        @else { " the difference up to a residual of " (residual) ", which is above the tolerance." }
    }
}

/// A fault at its lines of the file, and what to write there.
fn found(finding: &Diagnostic, fault: &Fault) -> Markup {
    html! {
        p.fault { (finding.message) }
        (marked(finding))
        @if fault.changes.is_empty() {
            @if !fault.suggestion.is_empty() { p { "To do: " (fault.suggestion) } }
        } @else {
            (changed(&fault.changes, finding.source.as_deref()))
        }
    }
}

fn stages(stage: &ReportedStage, at: &Pointer) -> Markup {
    let error = |key: &str| {
        let (error, at) = (if key == "before" { stage.before } else { stage.after }, at.key(key));
        html! {
            (value(&at.key("position_m"), error.position_m, &length(error.position_m))) " and "
            (value(&at.key("orientation_rad"), error.orientation_rad, &angle(error.orientation_rad)))
        }
    };
    html! { p.small { "difference of the tips before the correction " (error("before")) ", after it " (error("after")) } }
}

fn alternative(other: &ReportedAlternative) -> Markup {
    let cause = &other.cause;
    let residual = length_and_angle(cause.residual_m, cause.residual_rad);
    html! { li { (cause.fault.message) " (" (other.reason) "; residual " (residual) ")" } }
}
