//! A report as JUnit XML: one test case for each check, judged against what the scenario expects.

use std::{fs, io, path::Path};

use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

use super::{
    files::{OutputError, write_whole},
    run_report::RunReport,
};
use crate::{
    scenario::Expectation,
    verdict::{CheckResult, Measure, Status, Verdict},
};

/// Writes all scenarios as one JUnit document; makes the folder that it goes to.
///
/// # Errors
/// [`OutputError`] if the file cannot be written.
pub fn write_junit(path: &Path, reports: &[RunReport]) -> Result<(), OutputError> {
    let mut document = Report::new("congruent");
    document.add_test_suites(reports.iter().map(suite));
    let refused = |source| OutputError { path: path.to_owned(), source };
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(refused)?;
    }
    let text = document.to_string().map_err(|error| refused(io::Error::other(error)))?;
    write_whole(path, text.as_bytes())
}

fn suite(report: &RunReport) -> TestSuite {
    let mut suite = TestSuite::new(printable(&report.scenario));
    for (index, check) in report.checks.iter().enumerate() {
        suite.add_test_case(case(index, check, report));
    }
    if report.verdict == Verdict::NothingChecked || report.error.is_some() {
        let mut status = TestCaseStatus::non_success(NonSuccessKind::Error);
        status.set_message(printable(report.error.as_deref().unwrap_or("nothing was checked")));
        suite.add_test_case(TestCase::new("run", status));
    }
    suite
}

fn case(index: usize, check: &CheckResult, report: &RunReport) -> TestCase {
    let must_fail = match &report.expected {
        Expectation::Pass => false,
        Expectation::Fail { checks } => checks.is_empty() || checks.contains(&check.check),
    };
    let mut status = match check.status {
        Status::Pass if !must_fail => TestCaseStatus::success(),
        Status::Fail if must_fail => TestCaseStatus::success(),
        // With no kind named, any one failure is enough.
        Status::Pass if report.verdict == Verdict::AsExpected => TestCaseStatus::success(),
        Status::Skipped => TestCaseStatus::skipped(),
        Status::Error => TestCaseStatus::non_success(NonSuccessKind::Error),
        Status::Pass | Status::Fail => TestCaseStatus::non_success(NonSuccessKind::Failure),
    };
    let text: Vec<String> = check.measures.iter().map(sentence).chain(check.notes.clone()).collect();
    let text = printable(&text.join("; "));
    match &status {
        TestCaseStatus::Success { .. } => {}
        _ if must_fail && check.status == Status::Pass => {
            status.set_message(format!("expected to fail, but passed: {text}"));
        }
        _ => {
            status.set_message(text.clone());
        }
    }
    let mut case = TestCase::new(format!("{}_{}", index + 1, check.check.word()), status);
    case.set_classname(printable(&report.scenario)).set_system_out(text);
    case
}

/// One measure in words: `position 3.2e-10 m at tool0, t = 1.2 s, limit 1e-9`.
pub fn sentence(measure: &Measure) -> String {
    let (bound, unit, limit) = (measure.bound.words(), measure.unit, measure.limit);
    match &measure.worst {
        Some(worst) => format!(
            "{} {:.3e} {unit} at {} ({:.3} s), {bound} {limit:e} {unit}",
            measure.quantity, worst.value, worst.subject, worst.time_s
        ),
        None => format!("{}: no value, {bound} {limit:e} {unit}", measure.quantity),
    }
}

/// XML does not allow most control characters, and two further characters.
fn printable(text: &str) -> String {
    let has_place = |c: char| c == '\n' || !(c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}'));
    text.chars().map(|c| if has_place(c) { c } else { '\u{fffd}' }).collect()
}
