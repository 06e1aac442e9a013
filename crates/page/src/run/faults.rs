//! What went wrong, in sentences: the checks that failed, what the samples show, and why the models differ.

use congruent_agreement::report::foremost;
use congruent_fault_diagnosis::RunDiagnosis;
use congruent_monitors::verdict::Status;
use congruent_results::report::{RunReport, lines};
use maud::{Markup, html};

use crate::parts::{Pointer, diagnosis};

/// Lines of a check that failed which are shown above the table.
const SHOWN: usize = 8;

/// The section; nothing if no check failed and nothing is injected.
pub(super) fn what_is_wrong(report: &RunReport) -> Markup {
    html! { (failures(report)) (cause(report)) (found(report)) (servos(report)) }
}

fn failures(report: &RunReport) -> Markup {
    let checks = report.checks_failed_first().into_iter();
    let failed: Vec<_> = checks.filter(|check| check.status == Status::Fail).collect();
    html! {
        @if !failed.is_empty() {
            section {
                h2 { "What failed" }
                @for check in failed {
                    div.card.bad {
                        h3 { (check.check) @if let Some(line) = check.line { span.small { " line " (line) " of the scenario" } } }
                        @let lines = lines(check);
                        ul { @for line in lines.iter().take(SHOWN) { li { (line) } } }
                        @if lines.len() > SHOWN { p.small { "and " (lines.len() - SHOWN) " more in the report" } }
                    }
                }
            }
        }
    }
}

/// Why model and twin differ, if a check of their agreement failed.
fn cause(report: &RunReport) -> Markup {
    let Some(shown) = foremost(&report.diagnoses) else { return html! {} };
    let index = report.diagnoses.iter().position(|other| std::ptr::eq(other, shown)).unwrap_or_default();
    html! {
        section {
            h2 { "Why model and twin differ" }
            (diagnosis(shown, &Pointer::root().key("diagnoses").key(index)))
        }
    }
}

/// The faults that the samples show, beside those that the scenario injects.
fn found(report: &RunReport) -> Markup {
    let sentences: Vec<String> = report.diagnosis.iter().flat_map(RunDiagnosis::sentences).collect();
    html! {
        @if !sentences.is_empty() || !report.faults.is_empty() {
            section {
                h2 { "Faults of the robot" }
                dl.facts {
                    @if !sentences.is_empty() {
                        dt { "diagnosed from the samples" }
                        dd { @for sentence in &sentences { p { (sentence) } } }
                    }
                    @if !report.faults.is_empty() {
                        dt { "injected by the scenario" }
                        dd { @for fault in &report.faults { p { (fault.sentence()) } } }
                    }
                }
            }
        }
    }
}

fn servos(report: &RunReport) -> Markup {
    html! {
        @if !report.servos.is_empty() {
            section {
                h2 { "Servos" }
                ul { @for servo in &report.servos { li { "motion " (servo.motion) ": " (servo.to_string()) } } }
            }
        }
    }
}
