//! What a recording says about its run, as an exit code with its reason. A file that is cut off or corrupt says nothing.

use super::summary::RecordingSummary;

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
    let Some(run) = &summary.run else {
        let reason = "no verdict: this program did not make the recording, or its run did not end";
        return (NOTHING_CHECKED, reason.to_owned());
    };
    (run.exit_code, run.error.clone().unwrap_or_else(|| run.sentence()))
}
