//! Why a run failed: why the models differ, what the samples show beside what was injected, and what became of servos.

use congruent_agreement::report::foremost;
use congruent_fault_diagnosis::RunDiagnosis;
use congruent_results::report::RunReport;
use maud::{Markup, html};

use crate::parts::{Pointer, diagnosis};

/// The sections; nothing if nothing differs and nothing is injected.
pub(super) fn causes(report: &RunReport) -> Markup {
    html! { (cause(report)) (found(report)) (servos(report)) }
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
