//! The scenarios of a call before they run, and those that `--resume` need not run again.

use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

use congruent::{
    PreparedScenario,
    input::{Diagnostic, Override, is_standard_input, not_found},
    results::{
        Options,
        files::{OutputFolder, result_files},
        finished,
        report::{RunReport, TestSuite, planned_suite},
    },
    scenario::scenario_name,
    text::layout::visible_path,
    twin::RunSetup,
};

use super::{arguments::Arguments, index::remove_index, run_answer::no_folder};
use crate::{
    batch::{Answer, Batch},
    codes,
    failure::Failure,
    terminal::print::Printer,
};

/// A scenario that was read.
pub(super) enum LoadedScenario {
    /// The scenario must run.
    New(Box<PreparedScenario>),
    /// The scenario has finished in an earlier call: its report and the folder of its results.
    Finished(Box<RunReport>, PathBuf),
}

impl LoadedScenario {
    /// The suite of the JUnit file until the scenario has run.
    pub(super) fn suite(&self) -> TestSuite {
        match self {
            Self::New(scenario) => planned_suite(&scenario.setup),
            Self::Finished(report, _) => report.test_suite(),
        }
    }
}

/// Refuses a scenario that does not exist, with the name that is meant or the command that makes one.
fn exists(path: &Path) -> Result<(), Diagnostic> {
    if path.exists() || is_standard_input(path) {
        return Ok(());
    }
    let missing = not_found(path, "");
    if missing.help.is_some() {
        return Err(missing);
    }
    Err(missing.with_help("give a scenario (.toml); `congruent new scenario ROBOT --to FILE.toml` makes one"))
}

/// Reads all scenarios before the first one runs, so that a fault in the last is known at once.
///
/// Results of earlier runs of the scenarios that will run are removed here, unless they are kept: of these, no results of
/// an earlier call remain after a call that is killed.
pub(super) fn load(
    arguments: &Arguments,
    options: &Options<'_>,
    batch: &Batch<'_>,
) -> Result<Vec<Answer<LoadedScenario>>, Failure> {
    let overrides = arguments.overrides();
    let mut folders: BTreeMap<PathBuf, PathBuf> = BTreeMap::new();
    let access = arguments.access.access()?;
    let mut load = |path: &PathBuf| {
        exists(path)?;
        let setup = RunSetup::load_with(path, &overrides, &access).and_then(RunSetup::for_simulation);
        let setup =
            setup.inspect_err(|_| note_older_results(path, &overrides, &arguments.out, batch.printer()))?;
        let scenario = PreparedScenario::new(setup, &access)?;
        let setup = &scenario.setup;
        let folder = OutputFolder::path_for(&arguments.out, &setup.scenario.name);
        if let Some(first) = folders.get(&folder) {
            return Err(same_folder(&folder, first, path).into());
        }
        let results = result_files(&folder);
        folders.insert(folder, path.clone());
        let inputs: Vec<PathBuf> = setup.inputs.iter().map(|input| input.path.clone()).collect();
        batch.reads(&inputs)?;
        batch.writes(&results)?;
        let earlier = arguments.resume.then(|| finished(setup, options)).flatten();
        if earlier.is_none() {
            OutputFolder::create(&arguments.out, &setup.scenario.name, &setup.inputs).map_err(no_folder)?;
        }
        batch.warn(path, &setup.description.warnings);
        batch.warn(path, &setup.warnings);
        Ok(match earlier {
            Some((report, folder)) => LoadedScenario::Finished(Box::new(report), folder),
            None => LoadedScenario::New(Box::new(scenario)),
        })
    };
    if arguments.scenarios.len() > 1 {
        remove_index(&arguments.out);
    }
    Ok(arguments.scenarios.iter().map(|path| batch.answer(path, || load(path))).collect())
}

/// Says that the results of an earlier run are still there: a mistake of typing must not delete them, and nobody may take
/// them for those of this call.
fn note_older_results(scenario: &Path, overrides: &[Override], out: &Path, printer: &Printer) {
    let Some(name) = scenario_name(scenario, overrides) else { return };
    let folder = OutputFolder::path_for(out, &name);
    if result_files(&folder).iter().any(|file| file.exists()) {
        let note = format!("{} keeps the results of an earlier run", visible_path(&folder));
        printer.notes([note.as_str()]);
    }
}

fn same_folder(folder: &Path, first: &Path, second: &Path) -> Diagnostic {
    let message = format!(
        "{} does not run, since {} writes to {} already",
        second.display(),
        first.display(),
        folder.display()
    );
    Diagnostic::error(codes::run::SAME_OUTPUT, message).with_help("give the scenarios different names")
}
