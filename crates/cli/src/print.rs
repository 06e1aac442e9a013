//! The one place that writes to the terminal. Results go to standard output, findings to
//! standard error.

use std::{
    fmt::Write as _,
    io::{self, IsTerminal, Write},
};

use clap::ValueEnum;
use congruent_description::Diagnostic;
use congruent_twin::report::Finding;
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

/// Prints in the format that was asked for.
#[derive(Debug)]
pub(crate) struct Printer {
    format: Format,
}

/// What stands on standard output when a command has no answer.
#[derive(Serialize)]
struct Refusal<'a> {
    error: &'a str,
    findings: Vec<Finding>,
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
            // `congruent ... | head` is no failure.
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
            result => result.map_err(machine),
        }
    }

    /// Warnings for people; in JSON they are part of the document.
    pub(crate) fn warnings(&self, warnings: &[Diagnostic]) {
        if self.format == Format::Human {
            for warning in warnings {
                to_stderr(&rendered(warning));
            }
        }
    }

    /// Why there is no result.
    pub(crate) fn failure(&self, failure: &Failure) {
        let (message, findings) = match failure {
            Failure::Input(findings) => ("bad input", findings.as_slice()),
            Failure::Machine(message) => (message.as_str(), [].as_slice()),
        };
        for finding in findings {
            to_stderr(&rendered(finding));
        }
        if findings.is_empty() {
            to_stderr(&format!("error: {message}\n"));
        }
        if self.format == Format::Json {
            let refusal = Refusal { error: message, findings: findings.iter().map(Finding::from).collect() };
            // Standard output may be gone; the exit code and standard error still tell.
            let _ = self.result(&refusal, |_| String::new());
        }
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
    // Nobody is left to tell when standard error is closed.
    let _ = io::stderr().lock().write_all(text.as_bytes());
}

/// A finding with the line it is about, as a compiler shows it.
pub(crate) fn rendered(finding: &Diagnostic) -> String {
    let plain = !io::stderr().is_terminal();
    let theme = if plain { GraphicalTheme::unicode_nocolor() } else { GraphicalTheme::unicode() };
    let handler = GraphicalReportHandler::new_themed(theme).with_width(100).with_links(false);
    let mut text = String::new();
    // Without a place in a text there is no snippet to carry the file's name.
    if let (None, Some(source)) = (finding.line_column(), &finding.source) {
        let _ = writeln!(text, "{}:", source.path.display());
    }
    if handler.render_report(&mut text, finding).is_err() {
        // The renderer refuses spans outside the text; the message must not be lost with it.
        let _ = writeln!(text, "{}: {finding}", finding.code);
    }
    text.push('\n');
    text
}
