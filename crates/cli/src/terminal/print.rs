//! The one file that writes to the terminal. Results go to standard output, findings to
//! standard error.

use std::{
    collections::BTreeSet,
    io::{self, BufWriter, IsTerminal, Write},
    iter::once_with,
    path::Path,
    sync::{Mutex, OnceLock},
};

use clap::ValueEnum;
use congruent::{
    input::{Diagnostic, Finding, Severity, serde_name, visible},
    text::{
        MOST_FINDINGS, TextOptions, finding_line, finding_text,
        layout::{fitted, for_people, visible_path},
        listed_findings,
    },
};
use serde::Serialize;

use crate::{
    failure::Failure,
    terminal::{columns, json_output::write_json},
};

/// How results are printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// Text for people.
    #[value(alias = "text")]
    Human,
    /// One JSON document on standard output.
    Json,
    /// One SARIF document on standard output, for code hosts. Only lint has it, and its help names it.
    #[value(hide = true)]
    Sarif,
}

/// When text for people is coloured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Color {
    /// On a terminal, unless `NO_COLOR` is set.
    Auto,
    /// In a pipe, too.
    Always,
    /// Never, not even on a terminal.
    Never,
}

/// How much is printed beside the answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Verbosity {
    /// Only the answer and errors (`--quiet`).
    Quiet,
    /// Warnings, and progress on a terminal.
    Usual,
    /// Also what was read, and findings in full.
    Verbose,
}

/// Set if findings are shown in full.
static IN_FULL: OnceLock<()> = OnceLock::new();

/// Set if nothing but errors is printed beside the answer.
static QUIET: OnceLock<()> = OnceLock::new();

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

impl<'a> From<&'a Failure> for Refusal<'a> {
    fn from(failure: &'a Failure) -> Self {
        let (error, findings) = match failure {
            Failure::Input(findings) => ("bad input", findings.iter()),
            Failure::Machine(message) => (message.as_str(), [].iter()),
        };
        Self {
            input: None,
            error,
            left_out: findings.len().saturating_sub(MOST_FINDINGS),
            findings: findings.take(MOST_FINDINGS).map(Finding::from).collect(),
        }
    }
}

impl Refusal<'_> {
    /// The same with the name of the input.
    pub(crate) fn with_input(self, input: &Path) -> Self {
        Self { input: Some(input.display().to_string()), ..self }
    }
}

impl Printer {
    pub(crate) fn new(format: Format, verbosity: Verbosity) -> Self {
        // There is one call.
        let _ = match verbosity {
            Verbosity::Verbose => IN_FULL.set(()),
            Verbosity::Quiet => QUIET.set(()),
            Verbosity::Usual => Ok(()),
        };
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
    pub(crate) fn parts<'a, T: Serialize, TextParts: Iterator<Item = String> + 'a>(
        &self,
        document: &'a T,
        text: impl FnOnce(&'a T) -> TextParts,
    ) -> Result<(), Failure> {
        let options = text_options();
        self.write(document, |document| text(document).map(move |text| options.laid_out(text)))
    }

    /// The same for a text that is a file, of which no line is broken.
    pub(crate) fn verbatim<T: Serialize>(
        &self,
        document: &T,
        text: impl FnOnce(&T) -> String,
    ) -> Result<(), Failure> {
        self.write(document, |document| once_with(move || text(document)))
    }

    fn write<'a, T: Serialize, TextParts: Iterator<Item = String> + 'a>(
        &self,
        document: &'a T,
        text: impl FnOnce(&'a T) -> TextParts,
    ) -> Result<(), Failure> {
        let mut out = BufWriter::new(io::stdout().lock());
        let written = match self.format {
            Format::Human => {
                let colours = text_options().colours();
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

    /// Writes lines of an answer that goes on, each at once. A closed pipe is an error: nobody reads what follows.
    pub(crate) fn lines<T: Serialize>(
        &self,
        text: fn(&T) -> String,
    ) -> impl FnMut(&T) -> io::Result<()> + use<T> {
        let format = self.format;
        move |line| {
            let mut out = BufWriter::new(io::stdout().lock());
            match format {
                Format::Human => {
                    out.write_all(for_people(&text(line), text_options().colours()).as_bytes())?;
                }
                Format::Json | Format::Sarif => write_json(line, &mut out)?,
            }
            out.flush()
        }
    }

    /// Warnings, each in one line; with --verbose in full, with the text of the file. Of several inputs the name of theirs is in
    /// front of each. A warning that was printed in this call, as of a robot of several scenarios, is shorter.
    pub(crate) fn warnings(&self, input: Option<&Path>, warnings: &[Diagnostic]) {
        if self.is_quiet() {
            return;
        }
        let shown = |warning: &Diagnostic| match self.format {
            Format::Human if !is_first(warning) => {
                format!("{}warning, as above: {}\n", named(input), visible(&warning.message))
            }
            Format::Human if self.verbosity == Verbosity::Verbose => labelled(input, warning),
            Format::Human => {
                let line = in_one_line(input, warning);
                text_options().columns.map_or(line.clone(), |columns| fitted(&line, columns))
            }
            Format::Json | Format::Sarif => in_one_line(input, warning),
        };
        to_stderr(&warnings.iter().map(shown).collect::<String>());
    }

    /// Remarks beside the answer, one line each.
    pub(crate) fn notes<'a>(&self, notes: impl IntoIterator<Item = &'a str>) {
        if self.format == Format::Human && !self.is_quiet() {
            notes.into_iter().for_each(|note| to_stderr(&format!("note: {note}\n")));
        }
    }

    /// What the caller seems to have meant instead: also with --quiet, whose answer would look like one to it.
    pub(crate) fn hint(&self, hint: &str) {
        if self.format == Format::Human {
            to_stderr(&format!("note: {hint}\n"));
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
            Failure::Input(findings) => {
                let is_error = |finding: &&Diagnostic| finding.severity == Severity::Error;
                let shown: Vec<&Diagnostic> =
                    findings.iter().filter(|of| QUIET.get().is_none() || is_error(of)).collect();
                let listed =
                    listed_findings(shown.into_iter(), &text_options(), |finding| labelled(input, finding));
                let first = findings.iter().find(is_error);
                listed + &explained_where(first.or(findings.iter().next()))
            }
        };
        to_stderr(&text);
    }

    /// How one of several inputs has ended, for people, on standard error: the results follow in the order of the inputs.
    pub(crate) fn ended(&self, input: &Path, word: &str) {
        if self.format == Format::Human && !self.is_quiet() {
            to_stderr(&format!("{}: {word}\n", visible_path(input)));
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

    /// Whether only the answer is printed (`--quiet`).
    pub(crate) fn is_quiet(&self) -> bool {
        self.verbosity == Verbosity::Quiet
    }

    /// Whether progress may be drawn.
    pub(crate) fn is_interactive(&self) -> bool {
        self.format == Format::Human && !self.is_quiet() && io::stderr().is_terminal()
    }
}

fn machine(error: impl std::fmt::Display) -> Failure {
    Failure::Machine(format!("cannot write the result: {error}"))
}

fn to_stderr(text: &str) {
    // There is nothing to be done if standard error is closed.
    let _ = io::stderr().lock().write_all(for_people(text, text_options().colours()).as_bytes());
}

/// A finding below the name of the input that it belongs to.
fn labelled(input: Option<&Path>, finding: &Diagnostic) -> String {
    let word = serde_name(&finding.severity);
    let heading = input.map(|input| format!("{}: {word}\n", visible_path(input)));
    heading.unwrap_or_default() + &finding_text(finding, &text_options())
}

/// Where the code of an error is explained; said once in a call.
fn explained_where(finding: Option<&Diagnostic>) -> String {
    static SAID: OnceLock<()> = OnceLock::new();
    match finding {
        Some(finding) if SAID.set(()).is_ok() => {
            format!("more: congruent explain {}\n", finding.code.id_or_name())
        }
        _ => String::new(),
    }
}

/// Whether this call has not printed a warning yet.
fn is_first(warning: &Diagnostic) -> bool {
    static PRINTED: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());
    let text = finding_text(warning, &text_options());
    PRINTED.lock().map_or(true, |mut printed| printed.insert(text))
}

/// A finding in one line, behind the name of the input that it belongs to.
fn in_one_line(input: Option<&Path>, finding: &Diagnostic) -> String {
    format!("{}{}\n", named(input), finding_line(finding))
}

/// The name of an input in front of what is said of it.
fn named(input: Option<&Path>) -> String {
    input.map(|input| format!("{}: ", visible_path(input))).unwrap_or_default()
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

/// How texts of this call are laid out.
pub(crate) fn text_options() -> TextOptions {
    TextOptions { columns: columns(), is_coloured: is_coloured(), is_in_full: IN_FULL.get().is_some() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn findings_beyond_the_limit_are_counted() {
        let finding = Diagnostic::error(crate::codes::cli::VALUE, "this is wrong");
        let failure = Failure::Input(vec![finding; MOST_FINDINGS + 7].into());
        let refusal = Refusal::from(&failure);
        assert_eq!((refusal.findings.len(), refusal.left_out), (MOST_FINDINGS, 7));
    }
}
