//! What lint finds in the descriptions that another command reads.

use congruent_input::{Capability, Diagnostic, Finding, Severity, codes::mesh};
use congruent_lint::codes;
use schemars::JsonSchema;
use serde::Serialize;

use super::report::LintReport;

/// What lint finds in the descriptions of a check. What is needed by clearance alone, such as meshes, is beside the counts: a
/// check computes no distances.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct LintSummary {
    /// Number of findings that are errors.
    pub errors: usize,
    /// Number of findings that are warnings; those of one kind are one.
    pub warnings: usize,
    /// The worst of them, at most three.
    pub worst: Vec<Finding>,
    /// Findings that stop clearance alone, and those of meshes. They never fail a check.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub for_clearance: Vec<Finding>,
    /// Whether a finding fails the check (--strict).
    pub is_strict: bool,
}

impl LintSummary {
    /// Most findings that are listed. Kind: choice.
    const MOST_LISTED: usize = 3;

    /// What the reports of several descriptions have together.
    pub fn from_reports(reports: impl IntoIterator<Item = LintReport>) -> Self {
        let all = reports.into_iter().flat_map(|report| report.diagnostics);
        // Meshes of visual shapes stop nothing, and a check compares no shapes.
        let is_for_clearance = |found: &Diagnostic| {
            found.stops == Some(Capability::Clearance) || found.code.area() == mesh::NOT_FOUND.area()
        };
        let (for_clearance, mut found): (Vec<_>, Vec<_>) = all.partition(is_for_clearance);
        found.sort_by_key(badness);
        let errors = found.iter().filter(|found| found.severity == Severity::Error).count();
        let worst = found.iter().take(Self::MOST_LISTED).map(Finding::from).collect();
        let for_clearance = for_clearance.iter().map(Finding::from).collect();
        Self { errors, warnings: found.len() - errors, worst, for_clearance, is_strict: false }
    }

    /// Number of all findings.
    pub fn findings(&self) -> usize {
        self.errors + self.warnings
    }
}

/// Errors, then values in another unit, which are wrong by a large factor, then everything else in the order found.
fn badness(found: &Diagnostic) -> (bool, bool) {
    (found.severity != Severity::Error, found.code.area() != codes::units::INERTIA.area())
}
