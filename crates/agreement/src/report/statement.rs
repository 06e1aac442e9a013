//! A diagnosis in a few lines of plain text, for reports that show no lines of files.

use std::slice;

use congruent_input::{Diagnostic, Finding, display::length_and_angle};

use super::content::{Fault, PastedLines, ReportedCause, ReportedDiagnosis};
use crate::diagnosis::Cause;

impl ReportedCause {
    /// The faults of the cause, each by itself, the one with the largest effect first.
    pub fn faults(&self) -> &[Fault] {
        if self.parts.is_empty() { slice::from_ref(&self.fault) } else { &self.parts }
    }
}

impl ReportedDiagnosis {
    /// Whether a cause was found whose residual is within the tolerance.
    pub fn is_explained(&self) -> bool {
        self.named_cause().is_some_and(|cause| cause.within_tolerance)
    }

    /// The first cause, unless nothing was found.
    pub fn named_cause(&self) -> Option<&ReportedCause> {
        self.causes.first().filter(|cause| cause.fault.cause != Cause::Unexplained)
    }

    /// The first cause, one line for each of its faults: the place, what is wrong, what to write; the last has the
    /// residual after all of it. Empty if no cause was found.
    pub fn statements(&self) -> Vec<String> {
        let Some(cause) = self.named_cause() else { return Vec::new() };
        let line = |(finding, fault): (&Diagnostic, &Fault)| {
            // Without the lines to paste: a report of a run has one line for each fault.
            let help = Some(correction(fault));
            Finding { help, ..Finding::from(finding) }.to_string()
        };
        let mut lines: Vec<String> = self.findings.iter().zip(cause.faults()).map(line).collect();
        if let Some(last) = lines.last_mut() {
            let residual = length_and_angle(cause.residual_m, cause.residual_rad);
            let remains = if residual.contains(" and ") { "remain" } else { "remains" };
            last.push_str(&format!("; then {residual} {remains}"));
        }
        lines
    }
}

/// What to do about a fault, in a line: what to write in which line of its file, or advice in words.
fn correction(fault: &Fault) -> String {
    if fault.pasted.is_empty() {
        return fault.suggestion.clone();
    }
    let pasted: Vec<String> = fault.pasted.iter().map(PastedLines::in_words).collect();
    pasted.join("; ")
}

/// Of several diagnoses the one to show: the first that is explained, otherwise the first with a difference.
pub fn foremost(diagnoses: &[ReportedDiagnosis]) -> Option<&ReportedDiagnosis> {
    let explained = diagnoses.iter().find(|diagnosis| diagnosis.is_explained());
    explained.or_else(|| diagnoses.iter().find(|diagnosis| !diagnosis.causes.is_empty()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_to_write_are_part_of_a_sentence() {
        let pasted = |text: &str, place: &str| PastedLines { text: text.to_owned(), place: place.to_owned() };
        let row = pasted("    { joint = \"j\", d_mm = 302 },", "line 13");
        let fault = Fault { pasted: vec![row, pasted("sign = -1", "below line 8")], ..Fault::default() };
        let expected = "write in line 13: { joint = \"j\", d_mm = 302 }; write below line 8: sign = -1";
        assert_eq!(correction(&fault), expected);
        let words = Fault { suggestion: "exchange the two joints".to_owned(), ..Fault::default() };
        assert_eq!(correction(&words), "exchange the two joints");
    }
}
