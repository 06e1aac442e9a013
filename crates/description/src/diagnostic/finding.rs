//! Diagnostics in the JSON of reports, and as one line.

use std::fmt;

use schemars::JsonSchema;
use serde::Serialize;

use super::diagnostic::{Diagnostic, Occurrence, Severity, Use, line_column};

/// A diagnostic as programs read it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Finding {
    /// `error` or `warning`.
    pub severity: Severity,
    /// Of a warning: the use of the robot that cannot go on because of it.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub stops: Option<Use>,
    /// Stable name.
    pub code: &'static str,
    /// What is wrong.
    pub message: String,
    /// The file, if it is known.
    pub file: Option<String>,
    /// Line, from 1.
    pub line: Option<usize>,
    /// Column, from 1.
    pub column: Option<usize>,
    /// What to do.
    pub help: Option<String>,
    /// If this finding stands for several of its kind: each of them.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub places: Vec<FindingPlace>,
}

/// One of several findings of a kind.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct FindingPlace {
    /// What is wrong here.
    pub message: String,
    /// The link, joint or file that it is about.
    pub name: Option<String>,
    /// Line, from 1.
    pub line: Option<usize>,
    /// Column, from 1.
    pub column: Option<usize>,
}

impl From<&Diagnostic> for Finding {
    fn from(diagnostic: &Diagnostic) -> Self {
        let place = diagnostic.line_column();
        Self {
            severity: diagnostic.severity,
            stops: diagnostic.stops,
            code: diagnostic.code,
            message: diagnostic.message.clone(),
            file: diagnostic.source.as_ref().map(|source| source.path.display().to_string()),
            line: place.map(|(line, _)| line),
            column: place.map(|(_, column)| column),
            help: diagnostic.help.clone(),
            places: diagnostic
                .kind
                .occurrences
                .iter()
                .map(|found| finding_place(diagnostic, found))
                .collect(),
        }
    }
}

fn finding_place(diagnostic: &Diagnostic, found: &Occurrence) -> FindingPlace {
    let source = diagnostic.source.as_ref().zip(found.span.as_ref());
    let place = source.map(|(source, span)| line_column(&source.text, span.start));
    FindingPlace {
        message: found.message.clone(),
        name: found.name.clone(),
        line: place.map(|(line, _)| line),
        column: place.map(|(_, column)| column),
    }
}

/// One line: the place, what is wrong, what to do.
impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (&self.file, self.line) {
            (Some(file), Some(line)) => write!(f, "{file}:{line}: ")?,
            (Some(file), None) => write!(f, "{file}: ")?,
            (None, _) => {}
        }
        f.write_str(&self.message)?;
        match &self.help {
            Some(help) => write!(f, "; {help}"),
            None => Ok(()),
        }
    }
}
