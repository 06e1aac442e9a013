//! Collecting what is wrong instead of stopping at the first fault.

use std::{path::Path, sync::Arc};

use crate::diagnostic::{Diagnostic, Severity, SourceFile};

/// What was found so far while reading one input.
#[derive(Debug, Default)]
pub struct Findings(Vec<Diagnostic>);

impl Findings {
    /// Adds a finding.
    pub fn push(&mut self, finding: Diagnostic) {
        self.0.push(finding);
    }

    /// Adds findings.
    pub fn extend(&mut self, findings: impl IntoIterator<Item = Diagnostic>) {
        self.0.extend(findings);
    }

    /// The value of `result`; its fault is kept here.
    pub fn keep<T>(&mut self, result: Result<T, Diagnostic>) -> Option<T> {
        result.map_err(|finding| self.push(finding)).ok()
    }

    /// Changes every finding.
    #[must_use]
    pub fn map(self, change: impl FnMut(Diagnostic) -> Diagnostic) -> Self {
        Self(self.0.into_iter().map(change).collect())
    }

    /// Whether anything found so far stops the work.
    pub fn has_error(&self) -> bool {
        self.0.iter().any(|finding| finding.severity == Severity::Error)
    }

    /// All findings in the order of the text.
    pub fn into_vec(mut self) -> Vec<Diagnostic> {
        self.0.sort_by(|one, other| place(one).cmp(&place(other)));
        self.0
    }

    /// All findings in the order of the text, each marked as being about `source` unless it
    /// already says otherwise.
    pub fn in_file(self, source: &Arc<SourceFile>) -> Vec<Diagnostic> {
        self.into_vec().into_iter().map(|finding| finding.in_file(source)).collect()
    }
}

/// By file, the one that is being read first, then by place in it.
fn place(finding: &Diagnostic) -> (Option<&Path>, Option<usize>) {
    let file = finding.source.as_ref().map(|source| source.path.as_path());
    (file, finding.span.as_ref().map(|span| span.start))
}
