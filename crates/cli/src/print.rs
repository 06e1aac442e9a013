//! The one file that writes to the terminal. Results go to standard output, findings to
//! standard error.

use std::{
    fmt::Write as _,
    io::{self, IsTerminal, Write},
    path::Path,
};

use clap::ValueEnum;
use congruent::description::{Diagnostic, Finding, serde_name};
use miette::{GraphicalReportHandler, GraphicalTheme};
use serde::Serialize;

use crate::failure::Failure;

/// How results are printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// For people.
    Human,
    /// One JSON document on standard output.
    Json,
}

/// Prints in the requested format.
#[derive(Debug)]
pub(crate) struct Printer {
    format: Format,
}

/// The JSON document of a command that has no result.
#[derive(Serialize)]
pub(crate) struct Refusal<'a> {
    /// The input that was refused, of several.
    #[serde(skip_serializing_if = "Option::is_none")]
    input: Option<String>,
    error: &'a str,
    findings: Vec<Finding>,
    /// Number of further findings.
    #[serde(skip_serializing_if = "is_zero")]
    left_out: usize,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes fields by reference")]
fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// Most findings that are shown; the others appear once these are corrected.
const MOST_FINDINGS: usize = 100;
/// Longest message or help that is shown to people, in bytes.
const MOST_SHOWN: usize = 2000;
/// Longest snippet: beyond it, a line fills the terminal and what is marked in it is not found.
const LONGEST_SNIPPET: usize = 500;

impl<'a> From<&'a Failure> for Refusal<'a> {
    fn from(failure: &'a Failure) -> Self {
        let (error, findings) = match failure {
            Failure::Input(findings) => ("bad input", findings.as_slice()),
            Failure::Machine(message) => (message.as_str(), [].as_slice()),
        };
        Self {
            input: None,
            error,
            findings: findings.iter().take(MOST_FINDINGS).map(Finding::from).collect(),
            left_out: findings.len().saturating_sub(MOST_FINDINGS),
        }
    }
}

impl Refusal<'_> {
    /// The same with the name of the input.
    pub(crate) fn of_input(self, input: &Path) -> Self {
        Self { input: Some(input.display().to_string()), ..self }
    }
}

impl Printer {
    pub(crate) fn new(format: Format) -> Self {
        Self { format }
    }

    /// The result of a command: the document as JSON, or the text for people.
    pub(crate) fn result<T: Serialize>(
        &self,
        document: &T,
        text: impl FnOnce(&T) -> String,
    ) -> Result<(), Failure> {
        let printed = match self.format {
            Format::Human => text(document),
            Format::Json => {
                let mut json = serde_json::to_string(document).map_err(machine)?;
                json.push('\n');
                json
            }
        };
        let mut out = io::stdout().lock();
        match out.write_all(printed.as_bytes()).and_then(|()| out.flush()) {
            // `congruent ... | head` is not a failure.
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
            result => result.map_err(machine),
        }
    }

    /// Warnings for people; in JSON they are part of the document.
    pub(crate) fn warnings(&self, warnings: &[Diagnostic]) {
        self.warnings_of(None, warnings);
    }

    /// The same with the name of the input in front of each, of several inputs.
    pub(crate) fn warnings_of(&self, input: Option<&Path>, warnings: &[Diagnostic]) {
        if self.format == Format::Human {
            to_stderr(&warnings.iter().map(|warning| labelled(input, warning)).collect::<String>());
        }
    }

    /// Why there is no result.
    pub(crate) fn failure(&self, failure: &Failure) {
        Self::explain(None, failure);
        if self.format == Format::Json {
            // Standard output may be closed; the exit code and standard error remain.
            let _ = self.result(&Refusal::from(failure), |_| String::new());
        }
    }

    /// Why a part of the result is missing: on standard error only, in one piece, with the name of the input of several.
    pub(crate) fn explain(input: Option<&Path>, failure: &Failure) {
        let text = match failure {
            Failure::Machine(message) => match input {
                Some(input) => format!("error: {}: {message}\n", input.display()),
                None => format!("error: {message}\n"),
            },
            Failure::Input(findings) => {
                let shown = findings.iter().take(MOST_FINDINGS).map(|finding| labelled(input, finding));
                let mut text: String = shown.collect();
                if let Some(more) = findings.len().checked_sub(MOST_FINDINGS).filter(|&more| more > 0) {
                    let _ = writeln!(text, "and {more} more");
                }
                text
            }
        };
        to_stderr(&text);
    }

    /// How one of several inputs has ended, for people, on standard error: the results follow in the order of the inputs.
    pub(crate) fn ended(&self, input: &Path, word: &str) {
        if self.format == Format::Human {
            to_stderr(&format!("{}: {word}\n", input.display()));
        }
    }

    /// Lines for a CI host, which reads them from standard error as well as from standard output.
    pub(crate) fn annotations(lines: &str) {
        to_stderr(lines);
    }

    /// Whether progress may be drawn.
    pub(crate) fn is_interactive(&self) -> bool {
        self.format == Format::Human && io::stderr().is_terminal()
    }
}

fn machine(error: impl std::fmt::Display) -> Failure {
    Failure::Machine(format!("cannot write the result: {error}"))
}

fn to_stderr(text: &str) {
    // There is nothing to be done if standard error is closed.
    let _ = io::stderr().lock().write_all(text.as_bytes());
}

/// A finding below the name of the input that it belongs to.
fn labelled(input: Option<&Path>, finding: &Diagnostic) -> String {
    let word = serde_name(&finding.severity);
    let heading = input.map(|input| format!("{}: {word}\n", input.display()));
    heading.unwrap_or_default() + &rendered(finding)
}

/// Whether text may be coloured: both outputs are terminals, since findings are shown on either, and the user has not
/// set `NO_COLOR` (<https://no-color.org>).
fn is_coloured() -> bool {
    let is_forbidden = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    !is_forbidden && io::stdout().is_terminal() && io::stderr().is_terminal()
}

/// A finding with the line it is about, as a compiler shows it.
pub(crate) fn rendered(finding: &Diagnostic) -> String {
    let plain = !is_coloured();
    let theme = if plain { GraphicalTheme::unicode_nocolor() } else { GraphicalTheme::unicode() };
    let handler = GraphicalReportHandler::new_themed(theme).with_width(100).with_links(false);
    let mut text = String::new();
    let finding = &shortened(finding);
    // Without a place in a text there is no snippet with the file's name.
    if let (None, Some(source)) = (&finding.span, &finding.source) {
        let _ = writeln!(text, "{}:", source.path.display());
    }
    if handler.render_report(&mut text, finding).is_err() {
        // The renderer rejects spans outside the text; the message is printed all the same.
        let _ = writeln!(text, "{}: {finding}", finding.code);
    }
    text.push('\n');
    text
}

/// The finding without what would fill the terminal: no snippet if its lines are long, and long messages
/// are cut.
fn shortened(finding: &Diagnostic) -> Diagnostic {
    let mut shortened = finding.clone();
    if let Some(stopped) = finding.stops {
        let _ = write!(shortened.message, " (stops {} alone)", serde_name(&stopped));
    }
    clip(&mut shortened.message);
    shortened.help.as_mut().map(clip);
    if let (Some(source), Some(span), Some((line, column))) =
        (&finding.source, &finding.span, finding.line_column())
        && snippet_bytes(&source.text, span) > LONGEST_SNIPPET
    {
        let _ = write!(shortened.message, " ({}:{line}:{column})", source.path.display());
        (shortened.source, shortened.span) = (None, None);
    }
    shortened
}

/// Length of the lines that a snippet would show.
fn snippet_bytes(text: &str, span: &std::ops::Range<usize>) -> usize {
    let bytes = text.as_bytes();
    let is_break = |&byte: &u8| byte == b'\n';
    let (start, end) = (span.start.min(bytes.len()), span.end.min(bytes.len()));
    let before = bytes[..start].iter().rev().position(is_break).unwrap_or(start);
    let after = bytes[end..].iter().position(is_break).unwrap_or(bytes.len() - end);
    before + end.saturating_sub(start) + after
}

fn clip(text: &mut String) {
    if text.len() > MOST_SHOWN {
        let end = (0..=MOST_SHOWN).rev().find(|&end| text.is_char_boundary(end)).unwrap_or(0);
        text.truncate(end);
        text.push_str("...");
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use congruent::description::SourceFile;

    use super::*;

    fn finding(text: &str, span: std::ops::Range<usize>) -> Diagnostic {
        let source = Arc::new(SourceFile { path: "some.toml".into(), text: text.to_owned() });
        Diagnostic::error("a::fault", "this is wrong").at(span).in_file(&source)
    }

    #[test]
    fn a_finding_shows_its_line() {
        let text = rendered(&finding("a = 1\nb = 2\n", 6..7));
        assert!(text.contains("some.toml:2:1") && text.contains("b = 2"), "{text}");
    }

    #[test]
    fn a_long_line_is_not_shown_but_its_place_is() {
        let long = format!("a = 1\nb = \"{}\"\n", "x".repeat(1_000_000));
        let text = rendered(&finding(&long, 6..7));
        assert!(text.contains("some.toml:2:1") && text.len() < 1000, "{} bytes", text.len());
    }

    #[test]
    fn long_words_end() {
        let mut long = finding("a", 0..1);
        long.message = "\u{e9}".repeat(1_000_000);
        assert!(rendered(&long.clone().with_help(long.message.clone())).len() < 10 * MOST_SHOWN);
    }

    #[test]
    fn so_many_findings_are_counted_not_told() {
        let failure = Failure::Input(vec![finding("a", 0..1); MOST_FINDINGS + 7]);
        let refusal = Refusal::from(&failure);
        assert_eq!((refusal.findings.len(), refusal.left_out), (MOST_FINDINGS, 7));
    }
}
