//! `congruent sweep`: one scenario with many values.

mod merge;
mod page;
mod run;
mod status;
mod worst;

use crate::{failure::Failure, terminal::print::Printer};

/// One scenario with many values: a plan says which keys vary and how, each case is a run and a row, and the rows make a table and a
/// page that says which value matters.
///
/// `sweep run` runs cases in this process, on all cores; --shard and --cases cut a plan for several machines, `sweep status` says what is
/// missing, `sweep merge` makes the tables. A case has the same row wherever it runs.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    what: SweepCommand,
}

#[derive(Debug, clap::Subcommand)]
enum SweepCommand {
    Run(run::Arguments),
    Status(status::Arguments),
    Merge(merge::Arguments),
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    match &arguments.what {
        SweepCommand::Run(arguments) => run::run(arguments, printer),
        SweepCommand::Status(arguments) => status::run(arguments, printer),
        SweepCommand::Merge(arguments) => merge::run(arguments, printer),
    }
}
