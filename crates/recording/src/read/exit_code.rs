//! What a recording says about its run, as an exit code with its reason. A file that is cut off or corrupt says nothing.

use congruent_results::report::failing;
use serde_json::Value;

use super::summary::RecordingSummary;

/// The property that holds the exit code of the run.
const EXIT_CODE: &str = "congruent/exit_code";

/// The file is not what it should be.
const BAD_INPUT: u8 = 2;
/// There is no verdict.
const NOTHING_CHECKED: u8 = 4;

/// The exit code of a recording, and the reason for it.
pub(super) fn judge(summary: &RecordingSummary) -> (u8, String) {
    if let [first, others @ ..] = &summary.problems[..] {
        let more = if others.is_empty() { String::new() } else { format!(" (and {} more)", others.len()) };
        return (BAD_INPUT, format!("{first}{more}"));
    }
    if !summary.complete {
        return (BAD_INPUT, "the file was cut off, or its recording was not finished".to_owned());
    }
    let code = summary.properties.get(EXIT_CODE).and_then(Value::as_u64);
    let (Some(code), Some(verdict), Some(report)) =
        (code.and_then(|code| u8::try_from(code).ok()), summary.verdict.as_deref(), &summary.report)
    else {
        let reason = "no verdict: this program did not make the recording, or its run did not end";
        return (NOTHING_CHECKED, reason.to_owned());
    };
    if let Some(error) = report["error"].as_str() {
        return (code, error.to_owned());
    }
    let failed = failed(report);
    let found = match (verdict, failed.is_empty()) {
        ("nothing_checked", _) => return (code, "nothing was checked".to_owned()),
        (_, true) if code != 0 => return (code, "unexpected pass: every check passed".to_owned()),
        (_, true) => "every check passes".to_owned(),
        (_, false) => failed,
    };
    let against = if code == 0 { "as expected" } else { "against expectation" };
    (code, format!("{found}, {against}"))
}

/// The kinds of the checks that failed, as in `clearance and limits fail`; empty if none did.
fn failed(report: &Value) -> String {
    let checks = report["checks"].as_array().into_iter().flatten();
    let failed = checks.filter(|check| check["status"] == "fail");
    let kinds: Vec<&str> = failed.filter_map(|check| check["check"].as_str()).collect();
    failing(&kinds)
}
