//! A diagnosis in a few lines of plain text, for reports that show no lines of files.

use congruent_description::Finding;

use super::content::ReportedDiagnosis;
use crate::diagnosis::Cause;

impl ReportedDiagnosis {
    /// Whether a cause was found.
    pub fn is_explained(&self) -> bool {
        self.causes.first().is_some_and(|cause| cause.fault.cause != Cause::Unexplained)
    }

    /// The first cause, one line for each of its faults: the place, what is wrong, what to write. Empty if none was
    /// found.
    pub fn statements(&self) -> Vec<String> {
        if !self.is_explained() {
            return Vec::new();
        }
        self.findings.iter().map(|finding| Finding::from(finding).to_string()).collect()
    }
}

/// Of several diagnoses the one to show: the first that is explained, otherwise the first with a difference.
pub fn foremost(diagnoses: &[ReportedDiagnosis]) -> Option<&ReportedDiagnosis> {
    let explained = diagnoses.iter().find(|diagnosis| diagnosis.is_explained());
    explained.or_else(|| diagnoses.iter().find(|diagnosis| !diagnosis.causes.is_empty()))
}
