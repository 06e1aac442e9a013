//! `congruent.run`: a run of a scenario as the command makes it, with the series of what happened.

use std::{
    path::{Path, PathBuf},
    sync::atomic::AtomicBool,
};

use congruent::{
    PreparedScenario,
    input::{Diagnostic, Findings, Override},
    page::PageFormat,
    recording::RerunFormat,
    results::{ExecuteError, Options, RecordingFormat, report::RunReport},
    scenario::TrajectoryFormat,
    text::{TextOptions, run_text},
    twin::RunSetup,
};
use pyo3::{prelude::*, types::PyDict};

use super::{
    class::PythonReport,
    series::{Series, read_series},
    toml_value::toml_value,
};
use crate::{
    error::{failed, refused},
    interrupt::{OnInterrupt, interruptible},
    options::KeywordOptions,
    robot::access,
};

/// A run that has ended.
struct Ran {
    report: RunReport,
    series: Series,
    /// Where its results are, if they are kept.
    folder: Option<PathBuf>,
}

/// Why there is no report.
enum RunFailure {
    /// The input is wrong.
    Input(Findings),
    /// The machine failed, or the place for the results is refused.
    Machine(String),
}

impl From<Findings> for RunFailure {
    fn from(findings: Findings) -> Self {
        Self::Input(findings)
    }
}

impl RunFailure {
    fn machine(error: impl std::fmt::Display) -> Self {
        Self::Machine(error.to_string())
    }
}

/// Runs a scenario, as ``congruent run``, and gives what happened as arrays.
///
/// ``set`` replaces values of the scenario by the keys joined by dots: ``{"controller.stiffness": 500}``. Results are kept in a folder
/// of the scenario's name in ``out``, with ``trajectory.parquet`` unless the scenario asks for another table; without ``out``
/// nothing is kept. After Ctrl-C the run ends in order, what it has computed is in ``out``, and ``KeyboardInterrupt`` is raised.
#[pyfunction]
#[pyo3(signature = (scenario, **options))]
#[pyo3(text_signature = "(scenario, *, set=None, seed=None, out=None)")]
pub(crate) fn run(
    py: Python<'_>,
    scenario: PathBuf,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<PythonReport> {
    let mut keywords = KeywordOptions::new("run", options);
    let set: Option<Bound<'_, PyDict>> = keywords.take("set")?;
    let seed: Option<u64> = keywords.take("seed")?;
    let out: Option<PathBuf> = keywords.take("out")?;
    keywords.finish()?;
    let mut overrides = Vec::new();
    for (key, value) in set.into_iter().flatten() {
        let written = format!("{}={}", key.str()?, toml_value(&value)?);
        overrides.push(written.parse::<Override>().map_err(|finding| refused(py, finding))?);
    }
    overrides.extend(seed.map(Override::seed));
    // The run ends in order and writes what it has computed, as the command does.
    let ran = interruptible(py, OnInterrupt::Wait, move |interrupt| {
        execute_scenario(&scenario, &overrides, out.as_deref(), interrupt)
    })?;
    match ran {
        Ok(ran) => ran.into_report(py),
        Err(RunFailure::Input(findings)) => Err(refused(py, findings)),
        Err(RunFailure::Machine(message)) => Err(failed(py, &message)),
    }
}

fn execute_scenario(
    scenario: &Path,
    overrides: &[Override],
    out: Option<&Path>,
    interrupt: &AtomicBool,
) -> Result<Ran, RunFailure> {
    let access = access()?;
    let setup = RunSetup::load_with(scenario, overrides, &access)?;
    let mut setup = setup.for_simulation()?;
    // The series are read from a table of the run, also if the scenario asks for a log.
    let asked = *setup.scenario.output.trajectory.get_or_insert(TrajectoryFormat::Parquet);
    let table = if asked == TrajectoryFormat::Mcap { TrajectoryFormat::Parquet } else { asked };
    let scenario = PreparedScenario::new(setup, &access)?;
    let temporary = tempfile::tempdir().map_err(RunFailure::machine)?;
    // Without a folder nothing is kept, so what only people look at is not written.
    let for_people: &[&dyn RecordingFormat] = if out.is_some() { &[&RerunFormat, &PageFormat] } else { &[] };
    let beside: &[&dyn RecordingFormat] = if table == asked { &[] } else { &[&table] };
    let options = Options {
        out: out.unwrap_or(temporary.path()).to_owned(),
        recordings: [beside, for_people].concat(),
        interrupt: Some(interrupt),
    };
    let (report, folder) =
        congruent::run_scenario(&scenario, &options, &|_| {}).map_err(|error| match error {
            error @ ExecuteError::CannotRun { .. } => {
                let finding = Diagnostic::error(congruent::codes::run::CANNOT_RUN, error.to_string());
                RunFailure::Input(finding.into())
            }
            error => RunFailure::machine(error),
        })?;
    let table = Some(folder.file(table.file_name())).filter(|path| path.exists());
    let series =
        table.map_or(Ok(Series::default()), |path| read_series(&path)).map_err(RunFailure::machine)?;
    Ok(Ran { report, series, folder: out.map(|_| folder.path().to_owned()) })
}

impl Ran {
    fn into_report(self, py: Python<'_>) -> PyResult<PythonReport> {
        let Self { report, series, folder } = self;
        let results =
            folder.as_ref().map_or(String::new(), |folder| format!("  results in {}\n", folder.display()));
        let text = TextOptions::default().for_terminal(&(run_text(&report) + &results));
        let document = serde_json::to_string(&report).map_err(|error| failed(py, &error.to_string()))?;
        Ok(PythonReport {
            exit_code: report.exit_code,
            grade: None,
            headline: text.lines().next().unwrap_or_default().to_owned(),
            text,
            document,
            series: Some(series.into_python(py)?),
            folder,
        })
    }
}
