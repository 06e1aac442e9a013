//! A scenario from its setup to its results on disk, with the causes of what failed.

use congruent_results::{ExecuteError, Options, execute_with, files::OutputFolder, report::RunReport};
use congruent_twin::{Run, RunSetup};

use crate::replay::explain_recorded;

/// Runs a scenario, of a simulation or of a log, writes its results and returns the report.
///
/// `progress` is called with the number of steps taken.
///
/// # Errors
/// [`ExecuteError`] if there can be no report. A run that fails midway has one.
pub fn run_scenario<'a>(
    setup: &'a RunSetup,
    options: &Options<'a>,
    progress: impl FnMut(u64),
) -> Result<(RunReport, OutputFolder), ExecuteError> {
    execute_with(setup, options, Run::new, explain_recorded, progress)
}
