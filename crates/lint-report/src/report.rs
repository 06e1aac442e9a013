//! The report of `lint` on one file.

use std::sync::Arc;

use congruent_input::{Capability, ChangedLines, Diagnostic, Finding, SourceFile, TextEdit, changed_lines};
use congruent_lint::{FileKind, IgnoredFinding, SafeFix};
use schemars::JsonSchema;
use serde::Serialize;

/// What is wrong or suspicious in a file.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct LintReport {
    /// What the file is; `None` if it is nothing that can be linted.
    pub kind: Option<FileKind>,
    /// Verdict of all findings.
    pub verdict: LintVerdict,
    /// Number of findings that are errors.
    pub errors: usize,
    /// Number of findings that are warnings; those of one kind are one.
    pub warnings: usize,
    /// Uses that the findings block: kinematics, clearance, physics; empty for a scenario.
    pub stops: Vec<Capability>,
    /// The findings, in the order of the file.
    pub findings: Vec<LintFinding>,
    /// Whether only a part of the rules could be applied: those that compare values with each other need a robot that can be
    /// read, and an error prevents that.
    #[serde(skip_serializing_if = "std::ops::Not::not", default)]
    pub is_incomplete: bool,
    /// Findings that the robot file ignores.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub ignored: Vec<IgnoredFinding>,
    /// Corrections that are safe.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub fixes: Vec<LintFix>,
    /// The findings with the texts of their files, for printing.
    #[serde(skip)]
    pub diagnostics: Vec<Diagnostic>,
}

/// A safe correction: the file keeps its meaning, or refused text has only one possible meaning.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct LintFix {
    /// Number of the finding that it answers.
    pub id: String,
    /// Name of the code, such as `urdf::tree`.
    pub code: &'static str,
    /// What the correction changes, in a sentence.
    pub about: String,
    /// The file that the correction changes, as it was named.
    pub file: String,
    /// The lines that change.
    pub changed: Vec<ChangedLines>,
    /// The file with its text.
    #[serde(skip)]
    pub source: Arc<SourceFile>,
    /// The changes of the text.
    #[serde(skip)]
    pub edits: Vec<TextEdit>,
}

/// What findings come to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LintVerdict {
    /// There is no finding.
    Clean,
    /// Nothing is wrong, something is suspicious or missing.
    Warnings,
    /// At least one finding is an error.
    Errors,
    /// The file cannot be read.
    Unreadable,
}

/// A finding, and what it stops.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct LintFinding {
    /// The finding: severity, code, place, message and help.
    #[serde(flatten)]
    pub finding: Finding,
    /// Uses that the finding blocks; an error that is not about a single use blocks all.
    pub stopped_uses: Vec<Capability>,
}

impl LintFix {
    pub(crate) fn from_safe_fix(fix: SafeFix, source: &Arc<SourceFile>) -> Self {
        Self {
            id: fix.code.id_or_name().to_owned(),
            code: fix.code.name,
            about: fix.about,
            file: source.path.display().to_string(),
            changed: changed_lines(&source.text, &fix.edits),
            source: Arc::clone(source),
            edits: fix.edits,
        }
    }
}
