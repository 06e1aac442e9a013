//! Collects diagnostics, so that reading does not stop at the first fault.

use std::{path::Path, sync::Arc};

use crate::diagnostic::{Diagnostic, Severity, SourceFile};

/// The diagnostics of one input so far.
#[derive(Debug, Default)]
pub struct Diagnostics(Vec<Diagnostic>);

impl Diagnostics {
    /// Adds a diagnostic.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        self.0.push(diagnostic);
    }

    /// Adds diagnostics.
    pub fn extend(&mut self, diagnostics: impl IntoIterator<Item = Diagnostic>) {
        self.0.extend(diagnostics);
    }

    /// The value of `result`; an error is added here.
    pub fn keep<T>(&mut self, result: Result<T, Diagnostic>) -> Option<T> {
        result.map_err(|diagnostic| self.push(diagnostic)).ok()
    }

    /// Changes every diagnostic.
    #[must_use]
    pub fn map(self, change: impl FnMut(Diagnostic) -> Diagnostic) -> Self {
        Self(self.0.into_iter().map(change).collect())
    }

    /// Whether any of them stops the work.
    pub fn has_error(&self) -> bool {
        self.0.iter().any(|diagnostic| diagnostic.severity == Severity::Error)
    }

    /// All diagnostics in the order of the text.
    pub fn into_vec(mut self) -> Vec<Diagnostic> {
        self.0.sort_by(|one, other| place(one).cmp(&place(other)));
        self.0
    }

    /// All diagnostics in the order of the text, each marked as being about `source` unless it
    /// already says otherwise.
    pub fn in_file(self, source: &Arc<SourceFile>) -> Vec<Diagnostic> {
        self.into_vec().into_iter().map(|diagnostic| diagnostic.in_file(source)).collect()
    }
}

/// By file, first the one that is being read, then by place in it.
fn place(diagnostic: &Diagnostic) -> (Option<&Path>, Option<usize>) {
    let file = diagnostic.source.as_ref().map(|source| source.path.as_path());
    (file, diagnostic.span.as_ref().map(|span| span.start))
}
