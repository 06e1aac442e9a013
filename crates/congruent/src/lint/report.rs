//! What `lint` tells of a file.

use std::sync::Arc;

use congruent_description::{
    ChangedLines, Code, Diagnostic, FileKind, Finding, IgnoredFinding, SafeFix, SourceFile, TextEdit, Use,
    changed_lines,
};
use schemars::JsonSchema;
use serde::Serialize;

/// What is wrong or suspicious in a file.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct LintReport {
    /// What the file is; `None` if it is nothing that can be linted.
    pub kind: Option<FileKind>,
    /// What the findings come to.
    pub verdict: LintVerdict,
    /// Number of findings that are errors.
    pub errors: usize,
    /// Number of findings that are warnings; those of one kind are one.
    pub warnings: usize,
    /// What the robot cannot be used for because of them; empty of a scenario.
    pub stops: Vec<Use>,
    /// The findings, in the order of the file.
    pub findings: Vec<LintFinding>,
    /// What the robot file ignores.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub ignored: Vec<IgnoredFinding>,
    /// Corrections that are safe.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub fixes: Vec<LintFix>,
    /// The findings with the texts of their files, for printing.
    #[serde(skip)]
    pub diagnostics: Vec<Diagnostic>,
}

/// A correction that is safe: the file means the same after it, or what was refused has the one meaning that was left.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct LintFix {
    /// Number of the finding that it answers.
    pub id: String,
    /// Its name.
    pub code: &'static str,
    /// What it does.
    pub about: String,
    /// The file.
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
    /// Nothing was found.
    Clean,
    /// Nothing is wrong, something is suspicious or missing.
    Warnings,
    /// Something is wrong.
    Errors,
    /// The file cannot be read.
    Unreadable,
}

/// A finding, and what it stops.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct LintFinding {
    /// The finding.
    #[serde(flatten)]
    pub finding: Finding,
    /// What the robot cannot be used for because of it; an error without a use of its own stops all.
    pub stopped_uses: Vec<Use>,
}

impl LintFix {
    pub(super) fn of(fix: SafeFix, source: &Arc<SourceFile>) -> Self {
        Self {
            id: Code::find(fix.code).map_or_else(String::new, |code| code.to_string()),
            code: fix.code,
            about: fix.about,
            file: source.path.display().to_string(),
            changed: changed_lines(&source.text, &fix.edits),
            source: Arc::clone(source),
            edits: fix.edits,
        }
    }
}
