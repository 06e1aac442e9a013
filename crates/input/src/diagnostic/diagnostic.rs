//! A diagnostic says what is wrong with an input, at which place, and what to do: one type for all files that are read.

use std::{fmt, ops::Range, path::PathBuf, sync::Arc};

use miette::{LabeledSpan, MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::line_counter::LineCounter;
use crate::{
    code::Code,
    codes,
    nearest::DID_YOU_MEAN,
    visible::{visible, visible_lines},
};

/// A file that was read, kept so that a diagnostic can show the line.
#[derive(Debug, PartialEq, Eq)]
pub struct SourceFile {
    /// Path that the file was read from.
    pub path: PathBuf,
    /// Text of the file; empty if it is not text.
    pub text: String,
    /// Whether another file named it and it is outside of that file's project: then no line of it is quoted.
    pub is_foreign: bool,
}

impl SourceCode for SourceFile {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        lines_before: usize,
        lines_after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let read = self.text.read_span(span, lines_before, lines_after)?;
        Ok(Box::new(MietteSpanContents::new_named(
            visible(&self.path.to_string_lossy()).into_owned(),
            read.data(),
            *read.span(),
            read.line(),
            read.column(),
            read.line_count(),
        )))
    }
}

/// Whether work can go on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Severity {
    /// Suspicious; the run goes on.
    Warning,
    /// The input is refused.
    Error,
}

/// A use of a robot. Each use needs other parts of the description.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Capability {
    /// Poses of links: the tree and its joints. Every other use needs it.
    Kinematics,
    /// Distances and contacts: collision shapes with their meshes.
    Clearance,
    /// Motion under forces: inertias, damping, friction and efforts.
    Physics,
}

/// One of several findings that are reported as one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Occurrence {
    /// The message of this occurrence alone.
    pub message: String,
    /// Name of the link, joint or file that it is about; `None` without one.
    pub name: Option<String>,
    /// Byte range in the file; `None` if it is about the file as a whole.
    pub span: Option<Range<usize>>,
}

/// The words by which a finding is joined with others, and the findings that were joined.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Grouping {
    /// The common words, which follow the number of findings in a joined message, and the name of the thing of this one.
    pub plural_and_name: Option<(String, String)>,
    /// All findings that were joined into this one, itself the first; empty if it is the only one.
    pub occurrences: Vec<Occurrence>,
    /// Another place of the same file that explains this one.
    pub related: Option<Occurrence>,
}

/// One fault of an input, or one thing in it that is suspicious.
///
/// A parser knows the span, its caller the file: [`Diagnostic::in_file`] adds the file.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnostic {
    /// Whether work can go on.
    pub severity: Severity,
    /// Of a warning: the use of the robot that it blocks.
    pub stops: Option<Capability>,
    /// What kind of fault it is, with the stable name and number that tools may match on.
    pub code: &'static Code,
    /// What is wrong: a lowercase fragment that names the thing and the value.
    pub message: String,
    /// The words by which it is joined with others; boxed to keep errors small.
    pub kind: Box<Grouping>,
    /// How to correct it, as one or more lines.
    pub help: Option<String>,
    /// Byte range in the file; `None` if it is about the file as a whole.
    pub span: Option<Range<usize>>,
    /// The file, once known.
    pub source: Option<Arc<SourceFile>>,
}

impl Diagnostic {
    /// A diagnostic that stops the work. Its message is one line in which every character is shown, whatever names and
    /// values of files it quotes.
    pub fn error(code: &'static Code, message: impl Into<String>) -> Self {
        Self {
            severity: Severity::Error,
            stops: None,
            code,
            message: visible(&message.into()).into_owned(),
            kind: Box::default(),
            help: None,
            span: None,
            source: None,
        }
    }

    /// A diagnostic that does not stop the work.
    pub fn warning(code: &'static Code, message: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, ..Self::error(code, message) }
    }

    /// Sets severity and blocked use by the use that needs the faulty part: an error for kinematics, without which there is no
    /// robot, otherwise a warning.
    #[must_use]
    pub fn needed_by(self, needed_by: Option<Capability>) -> Self {
        let (severity, stops) = match needed_by {
            Some(Capability::Kinematics) => (Severity::Error, None),
            other => (Severity::Warning, other),
        };
        Self { severity, stops, ..self }
    }

    /// Lets findings with the same words be joined into one message, as in "12 `kind`: `name`, ...".
    #[must_use]
    pub fn one_of(mut self, kind: impl Into<String>, name: impl Into<String>) -> Self {
        let one_line = |text: String| visible(&text).into_owned();
        self.kind.plural_and_name = Some((one_line(kind.into()), one_line(name.into())));
        self
    }

    /// Adds the help: how to correct the fault.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(visible_lines(&help.into()).into_owned());
        self
    }

    /// Adds the place in the text.
    #[must_use]
    pub fn at(mut self, span: Range<usize>) -> Self {
        self.span = Some(span);
        self
    }

    /// Adds another place that explains this one.
    #[must_use]
    pub fn related_to(mut self, span: Range<usize>, message: impl Into<String>) -> Self {
        let message = visible(&message.into()).into_owned();
        self.kind.related = Some(Occurrence { message, name: None, span: Some(span) });
        self
    }

    /// Adds the file, unless it is known already.
    #[must_use]
    pub fn in_file(mut self, source: &Arc<SourceFile>) -> Self {
        self.source.get_or_insert_with(|| Arc::clone(source));
        self
    }

    /// Whether it is about an unknown key which this one was probably meant to be: that the key is missing then needs no
    /// finding of its own.
    pub fn is_misspelt(&self, key: &str) -> bool {
        let guess = format!("{DID_YOU_MEAN}\"{key}\"?");
        self.code == codes::toml::UNKNOWN_KEY
            && self.help.as_deref().is_some_and(|help| help.starts_with(&guess))
    }

    /// Line and column, both from 1, columns in characters; `None` without a span or a file.
    pub fn line_column(&self) -> Option<(usize, usize)> {
        let (source, span) = (self.source.as_ref()?, self.span.as_ref()?);
        Some(line_column(&source.text, span.start))
    }
}

/// Line and column of a byte offset, both from 1, columns in characters.
pub fn line_column(text: &str, offset: usize) -> (usize, usize) {
    LineCounter::new(text).line_column(offset)
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Diagnostic {}

impl miette::Diagnostic for Diagnostic {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        let name = self.code.name;
        Some(match self.code.id {
            Some(id) => Box::new(format!("{id} {name}")),
            None => Box::new(name),
        })
    }

    fn severity(&self) -> Option<miette::Severity> {
        Some(match self.severity {
            Severity::Warning => miette::Severity::Warning,
            Severity::Error => miette::Severity::Error,
        })
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.source.as_ref().map(|source| source.as_ref() as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let own = LabeledSpan::new_primary_with_span(None, self.span.clone()?);
        let related = self.kind.related.as_ref().and_then(|related| {
            Some(LabeledSpan::new_with_span(Some(related.message.clone()), related.span.clone()?))
        });
        Some(Box::new(std::iter::once(own).chain(related)))
    }
}
