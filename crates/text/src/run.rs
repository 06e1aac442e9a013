//! What `congruent run` prints of a scenario.

use std::fmt::Write;

use congruent_fault_diagnosis::RunDiagnosis;
use congruent_input::display::quantity;
use congruent_monitors::verdict::CheckResult;
use congruent_results::report::{
    RunReport, UncertaintyReport, VariedValue, case_lines, cases_title, lines, unfinished_words, verdict_line,
};
use congruent_twin::{CaseValue, source::ActuatorUse};

use super::layout::paragraph;

/// What `congruent run` prints of a scenario, except for the folder of its results: the verdict, then motions and checks,
/// those that failed first, then faults and their diagnosis.
pub fn run_text(report: &RunReport) -> String {
    let mut text = String::new();
    let _ = writeln!(
        text,
        "{}: {} ({}, {})",
        report.scenario,
        verdict_line(report.verdict, &report.sentence()),
        report.robot,
        length_of(report)
    );
    if let Some(error) = &report.error {
        let _ = writeln!(text, "  {error}");
    }
    for (index, motion) in report.motions.iter().enumerate() {
        if let Some(slowed) = &motion.slowed {
            let help = slowed.help.as_deref().unwrap_or_default();
            let _ = writeln!(text, "  motion {}   slowed: {}; {help}", index + 1, slowed.message);
        }
    }
    for servo in &report.servos {
        let _ = writeln!(text, "  motion {}   {servo}", servo.motion);
    }
    if report.uncertainty.is_some() {
        let _ = writeln!(text, "  with nominal values");
    }
    for check in report.checks_failed_first() {
        checked(&mut text, check);
    }
    let held_back = |used: &ActuatorUse| used.held_back(report.simulation.duration_s);
    for (index, held_back) in report.actuators.iter().filter_map(held_back).enumerate() {
        let _ = writeln!(text, "  {:10} {:7} {held_back}", if index == 0 { "actuators" } else { "" }, "");
    }
    if let Some(cases) = &report.uncertainty {
        in_cases(&mut text, report, cases);
    }
    if let Some(case) = &report.case {
        let values: Vec<String> = case.values.iter().map(CaseValue::words).collect();
        text += &paragraph(&format!("case {}: {}", case.case, values.join(", ")), 2, 4);
    }
    for fault in &report.faults {
        let _ = writeln!(text, "  {:10} {:7} {}", "injected", "", fault.sentence());
    }
    for sentence in report.diagnosis.iter().flat_map(RunDiagnosis::sentences) {
        let _ = writeln!(text, "  {:10} {:7} {sentence}", "diagnosis", "");
    }
    text
}

/// How long the run was, or what it took of a log.
fn length_of(report: &RunReport) -> String {
    let duration = quantity(report.simulation.duration_s, "s");
    let steps = report.simulation.steps;
    match &report.source {
        Some(source) => format!("{duration} of {} in {} samples", source.log, steps + 1),
        None => format!("{duration} in {steps} steps"),
    }
}

/// What all cases show: first those checks that do not pass in as many as they must.
fn in_cases(text: &mut String, report: &RunReport, cases: &UncertaintyReport) {
    let varied: Vec<String> = cases.varied.iter().map(VariedValue::words).collect();
    *text += &paragraph(&format!("{}: {}", cases_title(cases), varied.join("; ")), 2, 4);
    for check in cases.checks_failed_first() {
        let status = check.requirement.verdict.status_word();
        labelled(text, [check.check.word(), status], &case_lines(cases, check));
    }
    for line in unfinished_words(cases) {
        *text += &paragraph(&line, 2, 4);
    }
    if let Some((what, command)) = report.command_of_cases() {
        let _ = writeln!(text, "  {what}: {command}");
    }
}

fn checked(text: &mut String, check: &CheckResult) {
    labelled(text, [check.check.word(), check.status.word()], &lines(check));
}

/// Lines behind a kind and a status, which the first has.
fn labelled(text: &mut String, label: [&str; 2], lines: &[String]) {
    for (index, line) in lines.iter().enumerate() {
        let [kind, status] = if index == 0 { label } else { [""; 2] };
        let _ = writeln!(text, "  {kind:10} {status:7} {line}");
    }
}
