//! Test suites as a summary in Markdown, which GitHub shows on the page of a run (`$GITHUB_STEP_SUMMARY`) and GitLab in a
//! comment. The worst come first.

use std::fmt::Write;

use congruent_input::{display::counted, visible};

use super::suite::{Reason, TestCase, TestResult, TestSuite};

/// The counts, a table of what did not pass with reasons, and the names of what passed.
pub fn step_summary(suites: &[TestSuite]) -> String {
    let count = |of: fn(&TestResult) -> bool| {
        suites.iter().flat_map(|suite| &suite.cases).filter(|case| of(&case.result)).count()
    };
    let errors = count(|result| matches!(result, TestResult::Error(_)));
    let is_change = |result: &TestResult| result.reason().is_some_and(Reason::is_change);
    let failures = count(|result| matches!(result, TestResult::Failed(reason) if !reason.is_change()));
    let changed = count(is_change);
    let passed = count(|result| matches!(result, TestResult::Passed));
    let skipped = count(|result| matches!(result, TestResult::Skipped(_)));
    let verdict = match (errors + failures, changed) {
        (0, 0) => "passed",
        (0, _) => "changed",
        _ => "failed",
    };
    let mut text = format!("### Congruent: {verdict}\n\n{passed} passed");
    let others =
        [(failures, "failed"), (errors, "with an error"), (changed, "changed"), (skipped, "skipped")];
    for (number, word) in others {
        if number > 0 {
            let _ = write!(text, ", {number} {word}");
        }
    }
    let _ = writeln!(text, " in {}\n", counted(suites.len(), "input"));
    if errors + failures + changed > 0 {
        text.push_str("| input | check | result | finding | line |\n|---|---|---|---|---|\n");
        rows(&mut text, suites, |result| matches!(result, TestResult::Error(_)));
        rows(&mut text, suites, |result| matches!(result, TestResult::Failed(_)));
        text.push('\n');
    }
    let sound = |suite: &&TestSuite| suite.cases.iter().all(|case| case.result.reason().is_none());
    let names: Vec<String> = suites.iter().filter(sound).map(passed_in_part).collect();
    if !names.is_empty() {
        let _ = writeln!(text, "Passed: {}", names.join(", "));
    }
    text
}

/// The name of a suite without failures, with what was skipped in it: nobody may take that for passed.
fn passed_in_part(suite: &TestSuite) -> String {
    let skipped = suite.cases.iter().filter(|case| matches!(case.result, TestResult::Skipped(_)));
    let skipped: Vec<String> = skipped.map(|case| escaped(&case.name)).collect();
    let name = escaped(&suite.name);
    if skipped.is_empty() { name } else { format!("{name} (not compared: {})", skipped.join(", ")) }
}

fn rows(text: &mut String, suites: &[TestSuite], of: fn(&TestResult) -> bool) {
    for suite in suites {
        for case in suite.cases.iter().filter(|case| of(&case.result)) {
            row(text, suite, case);
        }
    }
}

fn row(text: &mut String, suite: &TestSuite, case: &TestCase) {
    let Some(reason) = case.result.reason() else { return };
    let result = match case.result {
        TestResult::Error(_) => "error",
        _ if reason.is_change() => "changed",
        _ => "**failed**",
    };
    let message: Vec<String> = reason.message.lines().map(escaped).collect();
    let place = case.place.as_ref().map_or(String::new(), |place| format!("{}:{}", place.file, place.line));
    let _ = writeln!(
        text,
        "| {} | {} | {result} | {} | {} |",
        escaped(&suite.name),
        escaped(&case.name),
        message.join("<br>"),
        escaped(&place)
    );
}

/// Text of a file as text of a cell: nothing in it is Markdown or HTML.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in visible(text).chars() {
        match c {
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '&' => escaped.push_str("&amp;"),
            '|' | '`' | '*' | '_' | '[' | ']' | '\\' | '#' | '~' => {
                escaped.push('\\');
                escaped.push(c);
            }
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{CHANGED, CasePlace};

    fn reason(message: &str) -> Reason {
        Reason { kind: "clearance".to_owned(), message: message.to_owned() }
    }

    #[test]
    fn errors_come_before_failures_before_what_passed() {
        let mut failed =
            TestSuite::with_case("pick", "2_clearance", TestResult::Failed(reason("3 mm\n17 mm below")));
        failed.cases[0].place = CasePlace::if_known(Some("pick.toml"), Some(31));
        let suites = [
            TestSuite::with_case("weld", "1_limits", TestResult::Passed),
            failed,
            TestSuite::with_case("cut.toml", "start", TestResult::Error(reason("no such robot"))),
        ];
        assert_eq!(
            step_summary(&suites),
            "### Congruent: failed\n\n1 passed, 1 failed, 1 with an error in 3 inputs\n\n\
             | input | check | result | finding | line |\n|---|---|---|---|---|\n\
             | cut.toml | start | error | no such robot |  |\n\
             | pick | 2\\_clearance | **failed** | 3 mm<br>17 mm below | pick.toml:31 |\n\n\
             Passed: weld\n"
        );
    }

    #[test]
    fn a_change_is_no_failure() {
        let changed = Reason { kind: CHANGED.to_owned(), message: "moves tool0".to_owned() };
        let text =
            step_summary(&[TestSuite::with_case("arm", "change since main", TestResult::Failed(changed))]);
        assert!(text.starts_with("### Congruent: changed\n\n0 passed, 1 changed in 1 input\n"), "{text}");
        assert!(text.contains("| arm | change since main | changed | moves tool0 |"), "{text}");
    }

    #[test]
    fn a_name_is_text_and_nothing_else() {
        let name = "a | b\n# c <img src=x> `d` [e](f)";
        let text = step_summary(&[TestSuite::with_case(name, "c", TestResult::Failed(reason(name)))]);
        assert!(!text.contains("<img") && !text.contains("\n# c") && !text.contains("[e]"), "{text}");
        let row = text.lines().find(|line| line.contains("failed**")).unwrap();
        assert_eq!(row.replace("\\|", "").matches('|').count(), 6, "{row}");
    }
}
