//! `congruent schema`: the JSON schema of a file or of a document.

use std::fmt::Write as _;

use congruent::{
    input::{Diagnostic, known_names},
    schema::Document,
};

use crate::{codes, failure::Failure, terminal::print::Printer};

/// The JSON schema (draft 2020-12) of a file that is read or of a document that is printed.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// `robot`, `scenario`, `report`, `check`, …; all are listed without a name.
    document: Option<String>,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let Some(name) = &arguments.document else {
        let names: Vec<&str> = Document::ALL.iter().map(|document| document.name).collect();
        printer.result(&names, |_| listed())?;
        return Ok(0);
    };
    let document = Document::find(name).ok_or_else(|| {
        let known = Document::ALL.iter().map(|document| document.name);
        Diagnostic::error(codes::schema::DOCUMENT, format!("no schema is named \"{name}\""))
            .with_help(known_names(name, "schemas", known))
    })?;
    let schema = document.schema();
    let text = serde_json::to_string_pretty(&schema).map_err(|error| Failure::Machine(error.to_string()))?;
    printer.verbatim(&schema, |_| format!("{text}\n"))?;
    Ok(0)
}

/// One line for each document.
fn listed() -> String {
    Document::ALL.iter().fold(String::new(), |mut text, document| {
        let _ = writeln!(text, "{:15}  {}", document.name, document.about);
        text
    })
}
