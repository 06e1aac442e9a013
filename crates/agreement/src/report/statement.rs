//! A diagnosis in a few lines of plain text, for reports that show no lines of files.

use std::slice;

use congruent_input::{Diagnostic, Finding, display::length_and_angle, lines_in_words};

use super::content::{Fault, ReportedCause, ReportedDiagnosis};
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
            let help = Some(lines_in_words(&fault.pasted).unwrap_or_else(|| fault.suggestion.clone()));
            Finding { help, ..Finding::from(finding) }.to_string()
        };
        let mut lines: Vec<String> = self.findings.iter().zip(cause.faults()).map(line).collect();
        if let Some(last) = lines.last_mut() {
            let residual = length_and_angle(cause.residual_m, cause.residual_rad);
            last.extend(["; then ", &residual, " remain"]);
        }
        lines
    }
}

/// Of several diagnoses the one to show: the first that is explained, otherwise the first with a difference.
pub fn foremost(diagnoses: &[ReportedDiagnosis]) -> Option<&ReportedDiagnosis> {
    let explained = diagnoses.iter().find(|diagnosis| diagnosis.is_explained());
    explained.or_else(|| diagnoses.iter().find(|diagnosis| !diagnosis.causes.is_empty()))
}
