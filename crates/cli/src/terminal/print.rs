//! The one file that writes to the terminal. Results go to standard output, findings to
//! standard error.

use std::{
    fmt::Write as _,
    io::{self, BufWriter, IsTerminal, Write},
    iter::once_with,
    path::Path,
    sync::OnceLock,
};

use clap::ValueEnum;
use congruent::description::{Diagnostic, Finding, SourceFile, serde_name, visible};
use miette::{GraphicalReportHandler, GraphicalTheme};
use serde::Serialize;

use crate::{
    failure::Failure,
    terminal::{
        json_output::write_json,
        layout::{columns, fitted},
        status_colour::with_coloured_status,
        text::{Colours, for_people, shown, with_visible_lines},
    },
};

/// How results are printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// For people.
    #[value(alias = "text")]
    Human,
    /// One JSON document on standard output.
    Json,
    /// One SARIF document on standard output, which code hosts show: of `lint` alone.
    Sarif,
}

/// When what people read is coloured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Color {
    /// On a terminal, unless `NO_COLOR` is set.
    Auto,
    /// In a pipe, too.
    Always,
    /// Never.
    Never,
}

/// How much is printed beside the answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Verbosity {
    /// Errors alone.
    Quiet,
    /// Warnings, and progress on a terminal.
    Usual,
    /// Also what was read, and findings in full.
    Verbose,
}

/// Set if findings are shown in full.
static IN_FULL: OnceLock<()> = OnceLock::new();

/// The choice of a call; findings are rendered in many places.
static COLOR: OnceLock<Color> = OnceLock::new();

impl Color {
    /// Makes it the choice of this call.
    pub(crate) fn apply(self) {
        // There is one call.
        let _ = COLOR.set(self);
    }
}

/// Prints in the requested format.
#[derive(Debug)]
pub(crate) struct Printer {
    format: Format,
    verbosity: Verbosity,
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
pub(crate) const MOST_FINDINGS: usize = 100;
/// Longest message or help that is shown to people, in bytes.
const MOST_SHOWN: usize = 2000;
/// Columns of a finding, unless the terminal has less.
const WIDEST_FINDING: usize = 100;
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
    pub(crate) fn new(format: Format, verbosity: Verbosity) -> Self {
        if verbosity == Verbosity::Verbose {
            // There is one call.
            let _ = IN_FULL.set(());
        }
        Self { format, verbosity }
    }

    /// How results are printed.
    pub(crate) fn format(&self) -> Format {
        self.format
    }

    /// The result of a command: the document as JSON, or the text for people, in the columns of their terminal.
    pub(crate) fn result<T: Serialize>(
        &self,
        document: &T,
        text: impl FnOnce(&T) -> String,
    ) -> Result<(), Failure> {
        self.parts(document, |document| once_with(move || text(document)))
    }

    /// The same for a long text, whose parts of whole lines are made while it is written.
    pub(crate) fn parts<'a, T: Serialize, Parts: Iterator<Item = String> + 'a>(
        &self,
        document: &'a T,
        text: impl FnOnce(&'a T) -> Parts,
    ) -> Result<(), Failure> {
        let within = |text: String| match columns() {
            Some(columns) => fitted(&text, columns),
            None => text,
        };
        let in_colour = |text: String| if is_coloured() { with_coloured_status(&text) } else { text };
        self.write(document, |document| text(document).map(within).map(in_colour))
    }

    /// The same for a text that is a file, of which no line is broken.
    pub(crate) fn verbatim<T: Serialize>(
        &self,
        document: &T,
        text: impl FnOnce(&T) -> String,
    ) -> Result<(), Failure> {
        self.write(document, |document| once_with(move || text(document)))
    }

    fn write<'a, T: Serialize, Parts: Iterator<Item = String> + 'a>(
        &self,
        document: &'a T,
        text: impl FnOnce(&'a T) -> Parts,
    ) -> Result<(), Failure> {
        let mut out = BufWriter::new(io::stdout().lock());
        let written = match self.format {
            Format::Human => {
                let colours = colours();
                text(document).try_for_each(|part| {
                    let mut lines = part.split_inclusive('\n');
                    lines.try_for_each(|line| out.write_all(for_people(line, colours).as_bytes()))
                })
            }
            Format::Json | Format::Sarif => write_json(document, &mut out),
        };
        match written.and_then(|()| out.flush()) {
            // `congruent ... | head` is not a failure.
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
            result => result.map_err(machine),
        }
    }

    /// Warnings for people; beside a JSON document, which has them in full, each in one line. Of several inputs the name of
    /// theirs is in front of each.
    pub(crate) fn warnings(&self, input: Option<&Path>, warnings: &[Diagnostic]) {
        if self.verbosity == Verbosity::Quiet {
            return;
        }
        let shown = |warning: &Diagnostic| match self.format {
            Format::Human => labelled(input, warning),
            Format::Json | Format::Sarif => in_one_line(input, warning),
        };
        to_stderr(&warnings.iter().map(shown).collect::<String>());
    }

    /// Remarks that are no part of the answer, one line each.
    #[cfg_attr(not(feature = "recording"), expect(dead_code, reason = "said about recordings alone"))]
    pub(crate) fn notes<'a>(&self, notes: impl IntoIterator<Item = &'a str>) {
        if self.format == Format::Human && self.verbosity != Verbosity::Quiet {
            notes.into_iter().for_each(|note| to_stderr(&format!("note: {note}\n")));
        }
    }

    /// What was done, for those who ask with --verbose.
    pub(crate) fn detail(&self, detail: impl FnOnce() -> String) {
        if self.verbosity == Verbosity::Verbose {
            to_stderr(&format!("{}\n", detail()));
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
            Failure::Machine(message) => format!("error: {}{}\n", named(input), visible(message)),
            Failure::Input(findings) => shown_findings(findings.iter(), |finding| labelled(input, finding)),
        };
        to_stderr(&text);
    }

    /// How one of several inputs has ended, for people, on standard error: the results follow in the order of the inputs.
    pub(crate) fn ended(&self, input: &Path, word: &str) {
        if self.format == Format::Human && self.verbosity != Verbosity::Quiet {
            to_stderr(&format!("{}: {word}\n", shown(input)));
        }
    }

    /// Lines for a CI host, which reads them from standard error as well as from standard output.
    pub(crate) fn annotations(lines: &str) {
        // There is nothing to be done if standard error is closed.
        let _ = io::stderr().lock().write_all(lines.as_bytes());
    }

    /// What is wrong with the arguments.
    pub(crate) fn usage(error: &clap::Error) {
        to_stderr(&error.render().to_string());
    }

    /// Whether progress may be drawn.
    pub(crate) fn is_interactive(&self) -> bool {
        self.format == Format::Human && self.verbosity != Verbosity::Quiet && io::stderr().is_terminal()
    }
}

fn machine(error: impl std::fmt::Display) -> Failure {
    Failure::Machine(format!("cannot write the result: {error}"))
}

fn to_stderr(text: &str) {
    // There is nothing to be done if standard error is closed.
    let _ = io::stderr().lock().write_all(for_people(text, colours()).as_bytes());
}

/// A finding below the name of the input that it belongs to.
fn labelled(input: Option<&Path>, finding: &Diagnostic) -> String {
    let word = serde_name(&finding.severity);
    let heading = input.map(|input| format!("{}: {word}\n", shown(input)));
    heading.unwrap_or_default() + &rendered(finding)
}

/// `robot.toml: warning: robot.urdf:12: link "tool" has no mass; ...`.
fn in_one_line(input: Option<&Path>, finding: &Diagnostic) -> String {
    let text = Finding::from(finding).to_string();
    let text = text.lines().map(str::trim).collect::<Vec<_>>().join(" ");
    format!("{}{}: {text}\n", named(input), serde_name(&finding.severity))
}

/// The name of an input in front of what is said of it.
fn named(input: Option<&Path>) -> String {
    input.map(|input| format!("{}: ", shown(input))).unwrap_or_default()
}

/// Whether text is coloured. On its own only if both outputs are terminals, since findings are shown on either, and the user
/// has not set `NO_COLOR` (<https://no-color.org>).
fn is_coloured() -> bool {
    let is_forbidden = || std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    match COLOR.get() {
        Some(Color::Always) => true,
        Some(Color::Never) => false,
        Some(Color::Auto) | None => {
            !is_forbidden() && io::stdout().is_terminal() && io::stderr().is_terminal()
        }
    }
}

fn colours() -> Colours {
    if is_coloured() { Colours::Kept } else { Colours::Escaped }
}

/// The first findings, all with `--verbose`, and how many there are besides.
pub(crate) fn shown_findings<'a>(
    mut findings: impl ExactSizeIterator<Item = &'a Diagnostic>,
    show: impl Fn(&Diagnostic) -> String,
) -> String {
    let most = if IN_FULL.get().is_some() { usize::MAX } else { MOST_FINDINGS };
    let mut text: String = findings.by_ref().take(most).map(show).collect();
    if findings.len() > 0 {
        let _ = writeln!(text, "and {} more; --verbose shows all", findings.len());
    }
    text
}

/// A finding with the line it is about, as a compiler shows it.
pub(crate) fn rendered(finding: &Diagnostic) -> String {
    let plain = !is_coloured();
    let theme = if plain { GraphicalTheme::unicode_nocolor() } else { GraphicalTheme::unicode() };
    let handler = GraphicalReportHandler::new_themed(theme)
        .with_width(columns().map_or(WIDEST_FINDING, |columns| columns.min(WIDEST_FINDING)))
        .with_links(false);
    let mut text = String::new();
    let finding = &with_visible_lines(shortened(finding));
    // Without a place in a text there is no snippet with the file's name.
    if let (None, Some(source)) = (&finding.span, &finding.source) {
        let _ = writeln!(text, "{}:", shown(&source.path));
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
    // Beside the sign, which not everybody sees or knows.
    shortened.message.insert_str(0, ": ");
    shortened.message.insert_str(0, serde_name(&finding.severity));
    if let Some(stopped) = finding.stops {
        let _ = write!(shortened.message, " (stops {} alone)", serde_name(&stopped));
    }
    if IN_FULL.get().is_some() {
        return shortened;
    }
    clip(&mut shortened.message);
    shortened.help.as_mut().map(clip);
    let is_related_long = |source: &SourceFile| {
        let span = shortened.kind.related.as_ref().and_then(|related| related.span.as_ref());
        span.is_some_and(|span| snippet_bytes(&source.text, span) > LONGEST_SNIPPET)
    };
    if finding.source.as_deref().is_some_and(is_related_long) {
        shortened.kind.related = None;
    }
    if let (Some(source), Some(span), Some((line, column))) =
        (&finding.source, &finding.span, finding.line_column())
        && snippet_bytes(&source.text, span) > LONGEST_SNIPPET
    {
        let _ = write!(shortened.message, " ({}:{line}:{column})", shown(&source.path));
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
