//! `congruent compare`: the first difference between two runs.

use std::path::PathBuf;

use congruent::{compare_runs, input::Diagnostic, text::comparison_text};

use crate::{
    codes,
    failure::Failure,
    terminal::print::{Printer, text_options},
};

/// The first difference between two runs in time, joint and value, and the worst one of each series.
///
/// A and B are two reports (.json), two trajectories (.csv, .parquet), two recordings (.rrd), or two folders of
/// results. Rows are compared at the times that both have. Exit code 0 if nothing differs, 1 if something does, 2 if
/// they cannot be compared, 4 if they have no value in common.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// A report, trajectory, recording, or a folder of results.
    a: PathBuf,
    /// The same of the other run.
    b: PathBuf,
    /// Largest difference of two numbers that counts as none, in the unit of each series (m, rad, s). Above 0, the places, times
    /// and joint positions of worst values are not compared.
    #[arg(long, default_value_t = 0.0, value_name = "NUMBER")]
    tolerance: f64,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let comparison = compare_runs(&arguments.a, &arguments.b, arguments.tolerance).map_err(|error| {
        Diagnostic::error(codes::compare::NOT_COMPARABLE, error.to_string()).with_help(
            "compare takes two reports, two trajectories, two recordings, or two folders of results",
        )
    })?;
    printer.result(&comparison, |comparison| comparison_text(comparison, &text_options()))?;
    Ok(comparison.exit_code)
}
