//! Test suites as a summary in Markdown, which GitHub shows on the page of a run (`$GITHUB_STEP_SUMMARY`) and GitLab in a
//! comment. The worst come first.

use std::fmt::Write;

use congruent_input::{display::counted, visible};

use super::suite::{ChangeSince, TestCase, TestResult, TestSuite};

/// What changes since a revision, for the inputs that were compared with one; for the others the counts, a table of what did not
/// pass with reasons, and the names of what passed.
pub fn step_summary(suites: &[TestSuite]) -> String {
    let changes: Vec<(&TestSuite, &ChangeSince)> =
        suites.iter().filter_map(|suite| Some((suite, suite.change.as_ref()?))).collect();
    let others: Vec<&TestSuite> = suites.iter().filter(|suite| suite.change.is_none()).collect();
    let mut text = String::new();
    // One heading for each revision, in the order of the call.
    for (at, (_, ChangeSince { revision, .. })) in changes.iter().enumerate() {
        if changes[..at].iter().all(|(_, before)| before.revision != *revision) {
            let same = changes.iter().filter(|(_, change)| change.revision == *revision);
            since(&mut text, &same.copied().collect::<Vec<_>>());
        }
    }
    if changes.is_empty() || !others.is_empty() {
        text += &results(&others);
    }
    text
}

/// What changes since one revision: a line for each input.
fn since(text: &mut String, changes: &[(&TestSuite, &ChangeSince)]) {
    let Some((_, first)) = changes.first() else { return };
    let _ = writeln!(text, "### Changes since {}\n", escaped(first.short_revision()));
    for (suite, change) in changes {
        let [name, sentence] = [&suite.name, &change.sentence].map(|of| escaped(of));
        let _ = writeln!(text, "- **{name}**: {sentence}");
        let of_robot = |case: &&TestCase| !matches!(case.result, TestResult::Changed(_));
        for case in suite.cases.iter().filter(of_robot) {
            if let Some(message) = case.result.reason().and_then(|reason| reason.message.lines().next()) {
                let [case, message] = [&case.name, message].map(escaped);
                let _ = writeln!(text, "  - in the robot itself, {case}: {message}");
            }
        }
    }
    text.push('\n');
}

/// The counts, a table of what did not pass with reasons, and the names of what passed.
fn results(suites: &[&TestSuite]) -> String {
    let count = |of: fn(&TestResult) -> bool| {
        suites.iter().flat_map(|suite| &suite.cases).filter(|case| of(&case.result)).count()
    };
    let errors = count(|result| matches!(result, TestResult::Error(_)));
    let failures = count(|result| matches!(result, TestResult::Failed(_)));
    let passed = count(|result| matches!(result, TestResult::Passed));
    let skipped = count(|result| matches!(result, TestResult::Skipped(_)));
    let verdict = if errors + failures > 0 { "failed" } else { "passed" };
    let mut text = format!("### Congruent: {verdict}\n\n{passed} passed");
    for (number, word) in [(failures, "failed"), (errors, "with an error"), (skipped, "skipped")] {
        if number > 0 {
            let _ = write!(text, ", {number} {word}");
        }
    }
    let _ = writeln!(text, " in {}\n", counted(suites.len(), "input"));
    if errors + failures > 0 {
        text.push_str("| input | check | result | finding | line |\n|---|---|---|---|---|\n");
        rows(&mut text, suites, |result| matches!(result, TestResult::Error(_)));
        rows(&mut text, suites, |result| matches!(result, TestResult::Failed(_)));
        text.push('\n');
    }
    let sound = |suite: &&TestSuite| suite.cases.iter().all(|case| case.result.reason().is_none());
    let names: Vec<String> = suites.iter().copied().filter(sound).map(passed_in_part).collect();
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

fn rows(text: &mut String, suites: &[&TestSuite], of: fn(&TestResult) -> bool) {
    for suite in suites {
        for case in suite.cases.iter().filter(|case| of(&case.result)) {
            row(text, suite, case);
        }
    }
}

fn row(text: &mut String, suite: &TestSuite, case: &TestCase) {
    let Some(reason) = case.result.reason() else { return };
    let result = if matches!(case.result, TestResult::Error(_)) { "error" } else { "**failed**" };
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
    use crate::report::{CasePlace, Reason};

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
    fn changes_are_a_line_for_each_input_and_none_failed() {
        let changed = |name: &str, sentence: &str, result| TestSuite {
            change: Some(ChangeSince {
                revision: "main".to_owned(),
                sentence: sentence.to_owned(),
                is_changed: true,
                places: Vec::new(),
            }),
            ..TestSuite::with_case(name, "table", result)
        };
        let mut suites = vec![
            changed("arm", "moves tip by up to 10 mm", TestResult::Changed(reason("CHANGED"))),
            changed("leg", "no change in poses", TestResult::Failed(reason("10 mm\nmore"))),
        ];
        let of_changes = "### Changes since main\n\n- **arm**: moves tip by up to 10 mm\n\
             - **leg**: no change in poses\n  - in the robot itself, table: 10 mm\n\n";
        assert_eq!(step_summary(&suites), of_changes);
        suites.push(TestSuite::with_case("cut", "start", TestResult::Error(reason("no such robot"))));
        let whole = step_summary(&suites);
        assert!(
            whole.starts_with(&format!(
                "{of_changes}### Congruent: failed\n\n0 passed, 1 with an error in 1 input"
            )),
            "{whole}"
        );
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
