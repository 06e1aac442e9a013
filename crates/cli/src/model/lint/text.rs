//! The findings of one file for people.

use std::fmt::Write;

use congruent::{
    LintReport,
    description::{Severity, display::counted, serde_name},
};

use crate::terminal::print::{MOST_FINDINGS, rendered, shown_findings};

pub(super) fn text(report: &LintReport, difference: &str) -> String {
    // Errors are not among those that are left out for warnings.
    let of = |wanted| report.diagnostics.iter().filter(move |found| found.severity == wanted);
    let mut found: Vec<_> = report.diagnostics.iter().collect();
    if found.len() > MOST_FINDINGS {
        found = of(Severity::Error).chain(of(Severity::Warning)).collect();
    }
    let mut text = shown_findings(found.into_iter(), rendered);
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
    text
}
