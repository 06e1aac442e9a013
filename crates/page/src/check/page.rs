//! The page of a check: one robot, or several below a table of them.

use std::path::Path;

use congruent_agreement::{
    compare::{Agreement, CheckReport, DifferencesAt},
    report::{ReportedDiagnosis, foremost},
};
use congruent_description::Tolerance;
use congruent_input::{
    InputFile,
    display::{angle, length, length_and_angle},
    portable_path,
};
use maud::{Markup, html};

use super::{
    certificate::{certificate, picture},
    checked_robot::CheckedRobot,
    comparisons::comparisons,
    dynamics::{causes, dynamics},
};
use crate::parts::{
    BadgeKind, Pointer, Provenance, badge, capitalised, count, diagnosis, document, provenance, value,
    warnings,
};

/// One input of a check with its result.
#[derive(Debug, Clone)]
pub struct CheckEntry<'a> {
    /// The input as it was named.
    pub input: String,
    /// The report, or why there is none.
    pub result: Result<CheckedRobot<'a>, String>,
}

/// The page over all inputs, the worst first; `command` is the call that made it.
pub fn check_page(entries: &[CheckEntry<'_>], command: &str) -> String {
    // A single robot needs no table, and its values are at the root of the report.
    if let [CheckEntry { result: Ok(robot), .. }] = entries {
        let body = html! { (one(robot, &Pointer::root())) (provenance_of(&[robot], command)) };
        let title = format!("{}: {}", robot.geometry.robot, robot.answer);
        return document(&title, &body, None, &inputs_of(&[robot]));
    }
    let mut order: Vec<usize> = (0..entries.len()).collect();
    // Inputs without a report first, since `false` comes before `true`; then by outcome, from bad to good.
    order.sort_by_key(|&entry| (entries[entry].result.is_ok(), entry_outcome(&entries[entry]).0));
    let disagree = entries.iter().filter(|entry| entry_is_bad(entry)).count();
    let in_part = entries.iter().any(|entry| entry.result.as_ref().is_ok_and(is_in_part));
    let title = format!("{} robots checked", entries.len());
    let checked: Vec<&CheckedRobot<'_>> =
        entries.iter().filter_map(|entry| entry.result.as_ref().ok()).collect();
    let body = html! {
        header {
            p.kind { "Do the descriptions agree?" }
            h1 { (title) }
            p.verdict {
                @if disagree == 0 && in_part { (badge(BadgeKind::Unclear, "ALL AGREE IN WHAT WAS COMPARED")) }
                @else if disagree == 0 { (badge(BadgeKind::Good, "ALL AGREE")) }
                @else { (badge(BadgeKind::Bad, &format!("{disagree} OF {} DO NOT AGREE", entries.len()))) }
            }
        }
        (table(entries, &order))
        @for &at in &order {
            @if let Ok(robot) = &entries[at].result {
                article id=(format!("robot-{at}")) { (one(robot, &Pointer::root().key(at))) }
            }
        }
        (provenance_of(&checked, command))
    };
    document(&title, &body, None, &inputs_of(&checked))
}

fn table(entries: &[CheckEntry<'_>], order: &[usize]) -> Markup {
    html! {
        section {
            table {
                thead { tr { th { "robot" } th { "result" } th { "largest difference" } } }
                tbody {
                    @for &at in order {
                        @let entry = &entries[at];
                        @let (outcome, word) = entry_outcome(entry);
                        tr {
                            th scope="row" {
                                @if entry.result.is_ok() { a href=(format!("#robot-{at}")) { (entry.input) } }
                                @else { (entry.input) }
                            }
                            td { (badge(outcome, word)) }
                            td {
                                @match &entry.result {
                                    Ok(robot) => (largest(robot.geometry)),
                                    Err(reason) => (reason),
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Whether an input counts as one that does not agree.
fn entry_is_bad(entry: &CheckEntry<'_>) -> bool {
    entry.result.as_ref().map_or(true, |robot| robot.geometry.verdict != Agreement::Agree)
}

fn largest(report: &CheckReport) -> String {
    length_and_angle(report.worst.error.position_m, report.worst.error.orientation_rad)
}

/// The outcome, and the answer in the words of the command: what was not compared must not read as agreement.
fn entry_outcome<'e>(entry: &'e CheckEntry<'_>) -> (BadgeKind, &'e str) {
    match &entry.result {
        Ok(robot) => (outcome(robot), &robot.answer),
        Err(_) => (BadgeKind::Bad, "NOT CHECKED"),
    }
}

/// Whether what was compared agrees, and something was not compared.
fn is_in_part(robot: &CheckedRobot<'_>) -> bool {
    let agrees = robot.geometry.verdict == Agreement::Agree;
    agrees && ["NOT COMPARED", "NO SECOND"].iter().any(|words| robot.answer.contains(words))
}

/// Good only if everything was compared and agrees.
fn outcome(robot: &CheckedRobot<'_>) -> BadgeKind {
    match robot.geometry.verdict {
        Agreement::Disagree => BadgeKind::Bad,
        Agreement::Agree if !is_in_part(robot) => BadgeKind::Good,
        Agreement::Agree | Agreement::NothingCompared => BadgeKind::Unclear,
    }
}

/// The report on one robot, at a place of the document.
fn one(robot: &CheckedRobot<'_>, at: &Pointer) -> Markup {
    let differs = robot.geometry.verdict == Agreement::Disagree;
    html! {
        (header(robot, at))
        @if differs { (why(robot, at)) }
        (comparisons(robot.geometry, at))
        (certificate(robot, at))
        (dynamics(robot, at))
        @if !differs {
            @let picture = picture(robot);
            @if !picture.0.is_empty() { section { h2 { "The arm" } (picture) } }
        }
        (requested(robot.at_configurations, at))
        (warnings(&robot.findings))
    }
}

/// What follows the answer, as a sentence of its own.
fn sentence(details: &str) -> String {
    capitalised(details.trim_start_matches([',', ';', ':', '.', ' ']))
}

fn header(robot: &CheckedRobot<'_>, at: &Pointer) -> Markup {
    let report = robot.geometry;
    let named = |path: &Path| portable_path(path).display().to_string();
    html! {
        header {
            p.kind { "Do the descriptions agree?" }
            h1 { (report.robot) }
            p.verdict { (badge(outcome(robot), &robot.answer)) @if !robot.details.is_empty() { span.sentence { (sentence(&robot.details)) "." } } }
            dl.facts {
                dt { "file" } dd { code { (named(Path::new(&report.file))) } }
                @if let Some(other) = robot.other { dt { "against" } dd { code { (named(&other.path)) } } }
                dt { "compared" } dd { (report.chain) }
                dt { "at" } dd { (count(&at.key("configurations"), report.configurations)) " configurations, seed " (count(&at.key("seed"), report.seed)) }
                dt { "tolerance" }
                dd {
                    @match &robot.judged_by {
                        Some(judged_by) => (judged_by),
                        None => (tolerance(report, &at.key("tolerance"))),
                    }
                }
            }
            @for sentence in &robot.not_compared { p.note { (sentence) } }
            @for not_asked in &report.not_asked {
                @for finding in &not_asked.findings { p.note { "not compared: " (not_asked.source.name().replace('_', " ")) ": " (finding.message) } }
            }
        }
    }
}

/// The tolerance, and who gave it.
fn tolerance(report: &CheckReport, at: &Pointer) -> Markup {
    let Tolerance { position_m, orientation_rad } = report.tolerance;
    html! {
        (value(&at.key("position_m"), position_m, &length(position_m)))
        " and "
        (value(&at.key("orientation_rad"), orientation_rad, &angle(orientation_rad)))
        @if report.requested_tolerance.is_some() { " (by --tolerance)" }
        @else if !report.tolerance_is_declared { " (floating-point rounding: none is declared)" }
    }
}

/// The files of all robots, each once.
fn inputs_of(robots: &[&CheckedRobot<'_>]) -> Vec<InputFile> {
    let descriptions = robots.iter().flat_map(|robot| [Some(robot.description), robot.other]).flatten();
    let mut inputs: Vec<InputFile> = Vec::new();
    for input in descriptions.flat_map(|description| &description.inputs) {
        if !inputs.contains(input) {
            inputs.push(input.clone());
        }
    }
    inputs
}

/// The command, and the files that were read.
fn provenance_of(robots: &[&CheckedRobot<'_>], command: &str) -> Markup {
    let inputs = inputs_of(robots);
    let inputs = inputs.iter().collect();
    provenance(&Provenance { command: Some(command.to_owned()), inputs, remarks: Vec::new() })
}

/// Why the poses disagree, beside the arm where they do most.
fn why(robot: &CheckedRobot<'_>, at: &Pointer) -> Markup {
    if !robot.geometry.poses_disagree() {
        // Two arms that are equal would answer nothing.
        return html! { @if let Some(causes) = causes(robot) { section { h2 { "Why they differ" } (causes) } } };
    }
    let shown = foremost(&robot.geometry.diagnoses);
    let index_of = |shown: &ReportedDiagnosis| {
        robot.geometry.diagnoses.iter().position(|other| std::ptr::eq(other, shown)).unwrap_or_default()
    };
    html! {
        section {
            h2 { "Why they differ" }
            div.first {
                @if let Some(shown) = shown { div { (diagnosis(shown, &at.key("diagnoses").key(index_of(shown)))) } }
                (picture(robot))
            }
        }
    }
}

/// Configurations whose differences the page shows; a page with more is not read and does not open. Kind: choice.
const MOST_SHOWN: usize = 1000;

/// The differences at the configurations of --configurations.
fn requested(differences: Option<&DifferencesAt>, at: &Pointer) -> Markup {
    html! {
        @if let Some(differences) = differences {
            section {
                h2 { "At the requested configurations" }
                table {
                    thead { tr { th { "configuration" } th { "position" } th { "orientation" } } }
                    tbody {
                        @for (index, of) in differences.iter().take(MOST_SHOWN).enumerate() {
                            @let at = at.key("at_configurations").key(index);
                            tr {
                                th scope="row" { (index + 1) }
                                td data-label="position" { (value(&at.key("position_m"), of.error.position_m, &length(of.error.position_m))) }
                                td data-label="orientation" { (value(&at.key("orientation_rad"), of.error.orientation_rad, &angle(of.error.orientation_rad))) }
                            }
                        }
                    }
                }
                @if differences.len() > MOST_SHOWN {
                    p { "and " (differences.len() - MOST_SHOWN) " more in the JSON report" }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_follows_the_answer_is_a_sentence() {
        let details = ", by up to 5 mm at tool0; tolerance 1 pm";
        assert_eq!(sentence(details), "By up to 5 mm at tool0; tolerance 1 pm");
        assert_eq!(sentence(". DH table and URDF agree"), "DH table and URDF agree");
    }
}
