//! `congruent inspect`: what a recording holds, and its verdict.

use std::path::PathBuf;

use congruent::recording::inspect;

use crate::{failure::Failure, print::Printer};

/// What a recording holds: verdict, timelines, entities, statistics of its scalars.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// A recording (.rrd).
    recording: PathBuf,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let summary = inspect(&arguments.recording).map_err(|error| {
        congruent::description::Diagnostic::error("inspect::recording", error.to_string())
    })?;
    printer.result(&summary, ToString::to_string)?;
    Ok(0)
}
