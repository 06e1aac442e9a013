//! What `congruent run` prints of a scenario.

use std::fmt::Write;

use crate::{
    fault_diagnosis::RunDiagnosis,
    input::display::quantity,
    monitors::verdict::{CheckResult, Status, Verdict},
    results::report::{RunReport, lines},
    scenario::{CheckKind, Expectation},
    twin::source::ActuatorUse,
};

/// What `congruent run` prints of a scenario, except for the folder of its results: the verdict, then motions and checks,
/// those that failed first, then faults and their diagnosis.
pub fn run_text(report: &RunReport) -> String {
    let mut text = String::new();
    let verdict = match (report.verdict, &report.expected) {
        (Verdict::AsExpected, Expectation::Pass) => "pass".to_owned(),
        (Verdict::AsExpected, Expectation::Fail { .. }) => "pass (expected failure)".to_owned(),
        (Verdict::NotAsExpected, Expectation::Pass) => "FAIL".to_owned(),
        (Verdict::NotAsExpected, Expectation::Fail { checks }) => {
            format!("FAIL ({})", unexpected(report, checks))
        }
        (Verdict::NothingChecked, _) => "NOTHING CHECKED: add a [[check]]".to_owned(),
        (Verdict::Broken, _) => "BROKEN".to_owned(),
    };
    let _ = writeln!(
        text,
        "{}: {verdict} ({}, {} in {} steps)",
        report.scenario,
        report.robot,
        quantity(report.simulation.duration_s, "s"),
        report.simulation.steps
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
    for check in report.checks_failed_first() {
        checked(&mut text, check);
    }
    let held_back = |used: &ActuatorUse| used.held_back(report.simulation.duration_s);
    for (index, held_back) in report.actuators.iter().filter_map(held_back).enumerate() {
        let _ = writeln!(text, "  {:10} {:7} {held_back}", if index == 0 { "actuators" } else { "" }, "");
    }
    for fault in &report.faults {
        let _ = writeln!(text, "  {:10} {:7} {}", "injected", "", fault.sentence());
    }
    for sentence in report.diagnosis.iter().flat_map(RunDiagnosis::sentences) {
        let _ = writeln!(text, "  {:10} {:7} {sentence}", "diagnosis", "");
    }
    text
}

/// Why a failure is not the expected one: checks that did not fail although they should, and checks that failed as
/// well.
fn unexpected(report: &RunReport, expected: &[CheckKind]) -> String {
    let has_failed = |kind: &CheckKind| {
        report.checks.iter().any(|check| check.check == *kind && check.status == Status::Fail)
    };
    let listed = |kinds: Vec<&CheckKind>| kinds.iter().map(|kind| kind.word()).collect::<Vec<_>>().join(", ");
    let missing: Vec<&CheckKind> = expected.iter().filter(|kind| !has_failed(kind)).collect();
    let mut others: Vec<&CheckKind> = Vec::new();
    for CheckResult { check, .. } in report.checks.iter().filter(|check| check.status == Status::Fail) {
        if !expected.contains(check) && !others.contains(&check) {
            others.push(check);
        }
    }
    match (missing.is_empty(), others.is_empty()) {
        _ if expected.is_empty() => "a failure was expected, and no check failed".to_owned(),
        (false, true) => format!("expected to fail but did not: {}", listed(missing)),
        (true, _) => format!("failed although not expected to: {}", listed(others)),
        (false, false) => {
            format!("expected to fail but did not: {}; failed instead: {}", listed(missing), listed(others))
        }
    }
}

fn checked(text: &mut String, check: &CheckResult) {
    for (index, line) in lines(check).iter().enumerate() {
        let (kind, status) = if index == 0 { (check.check.word(), check.status.word()) } else { ("", "") };
        let _ = writeln!(text, "  {kind:10} {status:7} {line}");
    }
}
