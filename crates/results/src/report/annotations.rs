//! Checks that did not pass and changes since a revision, at their lines, as workflow commands of GitHub's runner
//! (<https://docs.github.com/actions/reference/workflow-commands-for-github-actions>). The one file that knows them.

use std::fmt::Write;

use congruent_input::visible_lines;

use super::suite::{CasePlace, ChangeSince, TestResult, TestSuite};

/// A line `::error file=...,line=...,title=...::message` for each case that failed or could not be checked. What changes since
/// a revision is a notice, and what disagrees in the input itself then a warning: the question was what changes.
pub fn github_annotations(suites: &[TestSuite]) -> String {
    let mut text = String::new();
    for suite in suites {
        if let Some(change) = suite.change.as_ref().filter(|change| change.is_changed) {
            changed(&mut text, &suite.name, change);
        }
        for case in &suite.cases {
            let command = match (&case.result, &suite.change) {
                (TestResult::Passed | TestResult::Skipped(_) | TestResult::Changed(_), _) => continue,
                (TestResult::Failed(_), Some(_)) => "warning",
                (TestResult::Failed(_), None) | (TestResult::Error(_), _) => "error",
            };
            let Some(reason) = case.result.reason() else { continue };
            let title = format!("{}: {}", suite.name, case.name);
            annotate(&mut text, command, case.place.as_ref(), &title, &reason.message);
            // One of each line, so that a change of several lines is marked at all of them.
            for (place, message) in &case.further {
                annotate(&mut text, command, Some(place), &title, message);
            }
        }
    }
    text
}

/// What changes as a whole, then each line that changes.
fn changed(text: &mut String, name: &str, change: &ChangeSince) {
    let title = format!("{name}: change since {}", change.short_revision());
    let first = change.places.first().map(|(place, _)| place);
    annotate(text, "notice", first, &title, &change.sentence);
    for (place, message) in &change.places {
        annotate(text, "notice", Some(place), &title, message);
    }
}

fn annotate(text: &mut String, command: &str, place: Option<&CasePlace>, title: &str, message: &str) {
    let _ = write!(text, "::{command} ");
    if let Some(CasePlace { file, line }) = place {
        let _ = write!(text, "file={},line={line},", property(file));
    }
    let _ = writeln!(text, "title={}::{}", property(title), data(message));
}

/// The message of a command: a line break would end the command.
fn data(text: &str) -> String {
    visible_lines(text).replace('%', "%25").replace('\n', "%0A")
}

/// A property of a command, which also ends at a colon or a comma.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{Reason, TestCase, TestResult};

    fn suite(name: &str, message: &str) -> TestSuite {
        let reason = Reason { kind: "clearance".to_owned(), message: message.to_owned() };
        let mut suite = TestSuite::with_case(name, "2_clearance", TestResult::Failed(reason));
        suite.cases[0].place = CasePlace::if_known(Some("a,b.toml"), Some(12));
        suite
    }

    #[test]
    fn what_failed_is_annotated_at_the_line_of_its_check() {
        assert_eq!(
            github_annotations(&[suite("pick", "distance 3 mm\nof a--b: 100 %")]),
            "::error file=a%2Cb.toml,line=12,title=pick%3A 2_clearance::distance 3 mm%0Aof a--b: 100 %25\n"
        );
    }

    /// What changes is a notice at each line, and what disagrees beside it a warning; neither is an error.
    #[test]
    fn a_change_is_a_notice() {
        let mut suite = suite("arm", "table and URDF differ");
        let place = CasePlace { file: "arm.urdf".to_owned(), line: 7 };
        let reason = Reason { kind: "changed".to_owned(), message: "CHANGED".to_owned() };
        let changed = TestCase { result: TestResult::Changed(reason), ..suite.cases[0].clone() };
        suite.cases.push(changed);
        suite.change = Some(ChangeSince {
            revision: "0123456789abcdef0123456789abcdef01234567".to_owned(),
            sentence: "moves tip by up to 10 mm".to_owned(),
            is_changed: true,
            places: vec![(place, "origin".to_owned())],
        });
        assert_eq!(
            github_annotations(&[suite]),
            "::notice file=arm.urdf,line=7,title=arm%3A change since 0123456789ab::moves tip by up to 10 mm\n\
             ::notice file=arm.urdf,line=7,title=arm%3A change since 0123456789ab::origin\n\
             ::warning file=a%2Cb.toml,line=12,title=arm%3A 2_clearance::table and URDF differ\n"
        );
    }

    #[test]
    fn a_name_adds_no_command() {
        let text = github_annotations(&[suite("x\n::set-env name=A::b\u{1b}[2J", "m\r\n::stop")]);
        assert_eq!(text.lines().count(), 1);
        assert!(!text.contains(['\r', '\u{1b}']), "{text:?}");
    }

    #[test]
    fn what_passed_is_not_annotated() {
        let mut suite = suite("pick", "");
        let skipped = TestResult::Skipped("nothing moves".to_owned());
        suite.cases[0].result = TestResult::Passed;
        let case = TestCase { result: skipped, ..suite.cases[0].clone() };
        suite.cases.push(case);
        assert_eq!(github_annotations(&[suite]), "");
    }
}
