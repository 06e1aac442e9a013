//! What `congruent lint` prints of a file.

use std::fmt::Write;

use super::{
    findings::{MOST_FINDINGS, finding_text, listed_findings},
    options::TextOptions,
};
use congruent_input::{Severity, display::counted, serde_name};
use congruent_lint_report::LintReport;

/// What `congruent lint` prints of a file: its findings, what `--fix` changes as a unified diff (empty without), and their
/// number.
pub fn lint_text(report: &LintReport, difference: &str, options: &TextOptions) -> String {
    // Errors are not among those that are left out for warnings.
    let of = |wanted| report.diagnostics.iter().filter(move |found| found.severity == wanted);
    let mut found: Vec<_> = report.diagnostics.iter().collect();
    if found.len() > MOST_FINDINGS {
        found = of(Severity::Error).chain(of(Severity::Warning)).collect();
    }
    let mut text = listed_findings(found.into_iter(), options, |finding| finding_text(finding, options));
    text += difference;
    for ignored in &report.ignored {
        let _ = writeln!(
            text,
            "ignored: {} {} ({}): {}",
            ignored.id,
            ignored.code,
            counted(ignored.places, "place"),
            ignored.reason
        );
    }
    let _ = match (report.errors, report.warnings) {
        (0, 0) => write!(text, "no findings"),
        (0, warnings) => write!(text, "{}", counted(warnings, "warning")),
        (errors, 0) => write!(text, "{}", counted(errors, "error")),
        (errors, warnings) => write!(text, "{}, {}", counted(errors, "error"), counted(warnings, "warning")),
    };
    let stops: Vec<&str> = report.stops.iter().map(serde_name).collect();
    if !stops.is_empty() {
        let _ = write!(text, "; the robot cannot be used for {}", stops.join(", "));
    }
    if !report.fixes.is_empty() && difference.is_empty() {
        let _ = write!(text, "; --fix corrects {}", counted(report.fixes.len(), "place"));
    }
    text.push('\n');
    if report.is_incomplete {
        let first = if report.errors == 1 { "the error" } else { "the errors" };
        let _ = writeln!(
            text,
            "not examined: units, and values that are compared with each other; correct {first} and run lint again"
        );
    }
    text
}
