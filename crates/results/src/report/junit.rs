//! Test suites as a JUnit file. The one file that knows the XML.

use std::{fs, io, path::Path, time::Duration};

use congruent_input::visible_lines;
use quick_junit::{NonSuccessKind, Property, Report, TestCaseStatus};

use super::suite::{Clock, TestResult, TestSuite};
use crate::files::{OutputError, write_whole};

/// Writes suites as one JUnit file; makes the folder that it goes to.
///
/// # Errors
/// [`OutputError`] if the file cannot be written.
pub fn write_junit(path: &Path, suites: &[TestSuite]) -> Result<(), OutputError> {
    let refused = |source| OutputError { path: path.to_owned(), source };
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(refused)?;
    }
    write_whole(path, junit(suites).map_err(refused)?.as_bytes())
}

/// Suites as the text of a JUnit file.
fn junit(suites: &[TestSuite]) -> io::Result<String> {
    let mut document = Report::new("congruent");
    document.set_time(duration(suites.iter().map(|suite| suite.time_s).sum()));
    document.add_test_suites(suites.iter().map(written_suite));
    document.to_string().map_err(io::Error::other)
}

fn written_suite(suite: &TestSuite) -> quick_junit::TestSuite {
    let mut written = quick_junit::TestSuite::new(printable(&suite.name));
    let clock = match suite.clock {
        Clock::Simulated => "simulated",
        Clock::Wall => "wall",
    };
    #[expect(clippy::cast_precision_loss, reason = "a suite has few cases")]
    let share = duration(suite.time_s / suite.cases.len().max(1) as f64);
    written.set_time(duration(suite.time_s)).add_property(Property::new("clock", clock));
    written.add_test_cases(suite.cases.iter().map(|case| {
        let mut written = quick_junit::TestCase::new(printable(&case.name), status(&case.result));
        written.set_classname(printable(&suite.name)).set_time(share);
        if let Some(place) = &case.place {
            // Attributes that GitLab and GitHub's reporters read; the format has no place of its own.
            let attributes = [("file", printable(&place.file)), ("line", place.line.to_string())];
            written.extra.extend(attributes.map(|(name, value)| (name.into(), value.into())));
        }
        // A failure has its text already.
        if !case.output.is_empty() && case.result.reason().is_none_or(|reason| reason.message != case.output)
        {
            written.set_system_out(printable(&case.output));
        }
        written
    }));
    written
}

fn status(result: &TestResult) -> TestCaseStatus {
    let (kind, reason) = match result {
        TestResult::Passed => return TestCaseStatus::success(),
        TestResult::Skipped(message) => {
            let mut status = TestCaseStatus::skipped();
            status.set_message(printable(message));
            return status;
        }
        TestResult::Failed(reason) | TestResult::Changed(reason) => (NonSuccessKind::Failure, reason),
        TestResult::Error(reason) => (NonSuccessKind::Error, reason),
    };
    let mut status = TestCaseStatus::non_success(kind);
    // Some viewers show the attribute, which has one line, others the text of the element.
    let line = reason.message.lines().collect::<Vec<_>>().join("; ");
    status.set_type(printable(&reason.kind)).set_message(printable(&line));
    status.set_description(printable(&reason.message));
    status
}

/// A time that is no duration, as of a run that never ended, counts as none.
fn duration(seconds: f64) -> Duration {
    Duration::try_from_secs_f64(seconds).unwrap_or_default()
}

/// XML does not allow most control characters, and readers of the file obey others.
fn printable(text: &str) -> String {
    visible_lines(text).into_owned()
}
