//! Checks that did not pass, at their lines, as workflow commands of GitHub's runner
//! (<https://docs.github.com/actions/reference/workflow-commands-for-github-actions>). The one file that knows them.

use std::fmt::Write;

use congruent_input::visible_lines;

use super::suite::{CasePlace, Reason, TestSuite};

/// A line `::error file=...,line=...,title=...::message` for each case that failed or could not be checked, with `::notice` for
/// what a change does.
pub fn github_annotations(suites: &[TestSuite]) -> String {
    let mut text = String::new();
    for suite in suites {
        for case in &suite.cases {
            if let Some(reason) = case.result.reason() {
                let title = format!("{}: {}", suite.name, case.name);
                text.push_str(level(reason));
                annotate(&mut text, case.place.as_ref(), &title, &reason.message);
                // One of each line, so that a change of several lines is marked at all of them.
                for (place, message) in &case.further {
                    text.push_str(level(reason));
                    annotate(&mut text, Some(place), &title, message);
                }
            }
        }
    }
    text
}

fn level(reason: &Reason) -> &'static str {
    if reason.is_change() { "::notice " } else { "::error " }
}

fn annotate(text: &mut String, place: Option<&CasePlace>, title: &str, message: &str) {
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
    use crate::report::{CHANGED, TestCase, TestResult};

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

    #[test]
    fn a_change_is_a_notice() {
        let mut changed = suite("arm", "moves tool0");
        changed.cases[0].result =
            TestResult::Failed(Reason { kind: CHANGED.to_owned(), message: "moves tool0".to_owned() });
        let text = github_annotations(&[changed]);
        assert!(text.starts_with("::notice file=") && text.lines().count() == 1, "{text}");
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
