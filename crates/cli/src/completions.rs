//! `congruent completions`: what a shell completes.

use clap::builder::PossibleValuesParser;
use clap_complete::{Shell, generate};
use congruent::schema::Document;
use serde::Serialize;

use crate::{failure::Failure, terminal::print::Printer};

/// Prints a script that lets a shell complete commands, options and their values.
///
/// For this session of bash: `source <(congruent completions bash)`. For all: bash
/// `~/.local/share/bash-completion/completions/congruent`, zsh `_congruent` in a folder of `fpath`, fish
/// `~/.config/fish/completions/congruent.fish`; `PowerShell` and elvish source it from their profile.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The shell whose script is printed.
    shell: Shell,
}

/// The script as JSON.
#[derive(Serialize)]
struct Script {
    shell: String,
    script: String,
}

pub(crate) fn run(
    arguments: &Arguments,
    mut command: clap::Command,
    printer: &Printer,
) -> Result<u8, Failure> {
    let schemas = PossibleValuesParser::new(Document::ALL.iter().map(|document| document.name));
    command = command.mut_subcommand("schema", |schema| {
        schema.mut_arg("document", |argument| argument.value_parser(schemas))
    });
    let mut script = Vec::new();
    let name = command.get_name().to_owned();
    generate(arguments.shell, &mut command, name, &mut script);
    let script = String::from_utf8(script).map_err(|error| Failure::Machine(error.to_string()))?;
    printer
        .verbatim(&Script { shell: arguments.shell.to_string(), script }, |script| script.script.clone())?;
    Ok(0)
}
