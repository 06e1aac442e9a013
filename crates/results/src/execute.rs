//! One scenario from its file to its results on disk.

use std::{
    path::{Path, PathBuf},
    sync::atomic::AtomicBool,
};

use congruent_monitors::{Recorder, Recorders, RecordingError, Sample};
use congruent_scenario::Scenario;
use congruent_twin::{Outcome, Run, RunError, RunSetup};

use crate::{
    files::{
        CASES, ComparedResults, FolderError, OutputError, OutputFolder, REPORT, compare_results, read_result,
    },
    report::{AfterRun, RunReport, earlier_report, explain, write_junit},
};

/// Which results are written, and to which folder.
#[derive(Clone)]
pub struct Options<'a> {
    /// The folder above the scenarios' own folders.
    pub out: PathBuf,
    /// The files that take the samples of the run, such as a recording for a viewer and a page: each kind once. They are
    /// completed in this order.
    pub recordings: Vec<&'a dyn RecordingFormat>,
    /// Ends the run in order if it is set: what was computed until then is written.
    pub interrupt: Option<&'a AtomicBool>,
}

/// A recording in progress: it takes samples, and the report at the end.
pub trait Recording: Recorder {
    /// Adds the results and closes the file.
    ///
    /// # Errors
    /// [`RecordingError`] if it cannot be written.
    fn finish(self: Box<Self>, report: &RunReport) -> Result<(), RecordingError>;
}

/// In place of a recording that could not be begun, with the reason: the run then has a report that says so.
struct NotBegun(String);

impl NotBegun {
    fn error(&self) -> RecordingError {
        RecordingError { message: self.0.clone() }
    }
}

impl Recorder for NotBegun {
    fn record(&mut self, _sample: &mut Sample<'_>) -> Result<(), RecordingError> {
        Err(self.error())
    }
}

impl Recording for NotBegun {
    fn finish(self: Box<Self>, _report: &RunReport) -> Result<(), RecordingError> {
        Err(self.error())
    }
}

/// A kind of recording.
pub trait RecordingFormat: Sync {
    /// Name of the file in the folder of the scenario.
    fn file_name(&self) -> &'static str;

    /// What becomes of a file that could not be completed.
    fn if_incomplete(&self) -> IfIncomplete;

    /// Creates the file of a run that is about to start.
    ///
    /// # Errors
    /// [`RecordingError`] if it cannot be written.
    fn begin(&self, path: &Path, run: &Run<'_>) -> Result<Box<dyn Recording>, RecordingError>;
}

impl std::fmt::Debug for Options<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Options")
            .field("out", &self.out)
            .field("recordings", &self.recordings.iter().map(|format| format.file_name()).collect::<Vec<_>>())
            .finish()
    }
}

/// Why there is no report.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExecuteError {
    /// There is no folder for the results; this was found before the run.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// Results cannot be written; this was found before the run.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// Results cannot be written after the run: the report is here instead.
    #[error("the results of scenario \"{}\" cannot be written: {source}", .report.scenario)]
    Lost {
        /// The report of the run, which could not be written.
        report: Box<RunReport>,
        /// Why it could not be written.
        source: OutputError,
    },
    /// The robot cannot be simulated as the scenario asks.
    #[error("scenario \"{scenario}\" cannot run: {source}")]
    CannotRun {
        /// Name of the scenario.
        scenario: String,
        /// Why the run cannot start.
        source: RunError,
    },
}

/// The report of an earlier call that would be the same now, and its folder, if all results are there, to the last byte.
///
/// See [`earlier_report`] for what is the same.
pub fn finished(setup: &RunSetup, options: &Options<'_>) -> Option<(RunReport, PathBuf)> {
    let folder = OutputFolder::path_for(&options.out, &setup.scenario.name);
    let report = earlier_report(setup, &read_result(&folder.join(REPORT)).ok()?)?;
    let recordings = formats(setup, options).map(RecordingFormat::file_name);
    let cases = report.uncertainty.as_ref().map(|_| CASES);
    let mut wanted = [REPORT, JUNIT, RESOLVED].into_iter().chain(cases).chain(recordings);
    let ComparedResults { intact, changed } = compare_results(&folder)?;
    (changed.is_empty() && wanted.all(|name| intact.contains(&name))).then_some((report, folder))
}

/// The files that the options ask for and that are not in the folder: they could not be completed.
pub fn missing_files(setup: &RunSetup, options: &Options<'_>, folder: &OutputFolder) -> Vec<&'static str> {
    let names = formats(setup, options).map(RecordingFormat::file_name);
    names.filter(|name| !folder.file(name).is_file()).collect()
}

/// The checks of the run for CI.
const JUNIT: &str = "junit.xml";
/// The scenario with every default.
const RESOLVED: &str = "scenario.resolved.toml";

/// Runs a scenario, writes its results and returns the report.
///
/// `progress` is called with the number of steps taken.
///
/// # Errors
/// [`ExecuteError`] if there can be no report. A run that fails midway has one.
pub fn execute(
    setup: &RunSetup,
    options: &Options<'_>,
    progress: impl FnMut(u64),
) -> Result<(RunReport, OutputFolder), ExecuteError> {
    execute_with(setup, options, Run::new, explain, progress)
}

/// The same with a source of the caller's, which `begin` puts into a run. `explain` finds the causes of failed checks.
///
/// # Errors
/// As [`execute`].
pub fn execute_with<'a>(
    setup: &'a RunSetup,
    options: &Options<'a>,
    begin: impl FnOnce(&'a RunSetup) -> Result<Run<'a>, RunError>,
    explain: impl FnOnce(&mut Run<'_>, &mut Outcome) -> AfterRun,
    progress: impl FnMut(u64),
) -> Result<(RunReport, OutputFolder), ExecuteError> {
    let folder = OutputFolder::create(&options.out, &setup.scenario.name, &setup.inputs)?;
    folder.write(RESOLVED, resolved_text(setup, &folder).as_bytes())?;
    let cannot_run =
        |source: RunError| ExecuteError::CannotRun { scenario: setup.scenario.name.clone(), source };
    let run = begin(setup).map_err(cannot_run)?.interrupted_by(options.interrupt);
    let formats: Vec<_> = formats(setup, options).collect();
    let RecordedRun { report, settled, .. } = record(run, &formats, &folder, explain, progress);
    match write_results(settled, &folder, &report).and_then(|()| folder.write_digests()) {
        Ok(()) => Ok((report, folder)),
        Err(source) => Err(ExecuteError::Lost { report: Box::new(report), source }),
    }
}

/// The resolved scenario; values of the robot that were set are not in it, so that a comment has the call that sets them again.
fn resolved_text(setup: &RunSetup, folder: &OutputFolder) -> String {
    // A case is written as the scenario that has it: its values are those that controllers do not know.
    let scenario = setup.uncertain_case.as_ref().map_or(&setup.scenario, |case| &case.known.scenario);
    let of_robot = setup.overrides.iter().filter(|change| change.starts_with("robot."));
    let set: Vec<String> = of_robot.map(|change| format!(" --set '{change}'")).collect();
    let scenario = relative_to(scenario, folder).to_toml();
    if set.is_empty() {
        return scenario;
    }
    format!("# Values of the robot were set: congruent run {RESOLVED}{}\n{scenario}", set.concat())
}

/// The scenario with every default, and its files by their paths from the results: nobody else has the folders of this machine.
fn relative_to(scenario: &Scenario, folder: &OutputFolder) -> Scenario {
    let place = folder.path().canonicalize();
    place.map_or_else(|_| scenario.clone(), |place| scenario.relative_to(&place))
}

/// The files that take samples; the trajectory is completed before the page, which links to files that are there.
fn formats<'a>(
    setup: &'a RunSetup,
    options: &'a Options<'_>,
) -> impl Iterator<Item = &'a dyn RecordingFormat> {
    let trajectory = setup.scenario.output.trajectory.as_ref().map(|format| format as &dyn RecordingFormat);
    trajectory.into_iter().chain(options.recordings.iter().copied())
}

/// A run that has ended, with the files that took its samples.
pub struct RecordedRun {
    /// The report, as the last of these files has it unless one could not be completed.
    pub report: RunReport,
    /// Why the run, or one of its files, could not be completed.
    pub result: Result<(), RunError>,
    settled: Vec<Settled>,
}

/// Runs to the end and writes the samples to files of these formats, and nothing else. `explain` finds the causes of failed
/// checks; `progress` is called with the number of steps taken. A file that cannot be created ends the run at its first sample.
pub fn record(
    mut run: Run<'_>,
    formats: &[&dyn RecordingFormat],
    folder: &OutputFolder,
    explain: impl FnOnce(&mut Run<'_>, &mut Outcome) -> AfterRun,
    progress: impl FnMut(u64),
) -> RecordedRun {
    let setup = run.setup();
    let sources = run.model().sources().to_vec();
    let mut recordings = Vec::new();
    for format in formats {
        let file = StreamedFile::new(*format);
        let recording = format.begin(&folder.file(&file.partial), &run);
        recordings.push((recording.unwrap_or_else(|error| Box::new(NotBegun(error.message))), file));
    }
    let mut recorders = Recorders::default();
    recorders.0.extend(recordings.iter_mut().map(|(recording, _)| &mut **recording as &mut dyn Recorder));
    let (mut outcome, mut result) = run.finish(&mut setup.checks(), &mut recorders, progress);
    let mut causes = explain(&mut run, &mut outcome);
    let case_table = causes.case_table.take();
    let report = |result: &Result<(), RunError>| {
        RunReport::new(setup, &sources, outcome.clone(), causes.clone(), result.as_ref().err())
    };
    let (mut recorded, mut settled) = (report(&result), Vec::new());
    // Before the page, which links to files that are there.
    if let Some(table) = case_table {
        settled.push(Settled { incomplete: None, result: folder.write(CASES, &table) });
    }
    for (recording, file) in recordings {
        let closed = file.settle(folder, recording.finish(&recorded), &mut settled);
        if let Err(error) = closed {
            // The error of the run is reported before an error of the recording that follows from it.
            result = result.and(Err(error.into()));
            recorded = report(&result);
        }
    }
    RecordedRun { report: recorded, result, settled }
}

/// Writes the report, whatever became of the other files.
fn write_results(
    settled: Vec<Settled>,
    folder: &OutputFolder,
    report: &RunReport,
) -> Result<(), OutputError> {
    let write = || {
        let written = write_report(folder, report);
        written.and(write_junit(&folder.file(JUNIT), &[report.test_suite()]))
    };
    let written = write().or_else(|error| {
        // On a full disk what is incomplete takes the space of the report, which matters more.
        let mut incomplete = settled.iter().filter_map(|file| file.incomplete.as_ref()).peekable();
        if incomplete.peek().is_none() {
            return Err(error);
        }
        incomplete.try_for_each(|partial| folder.remove(partial))?;
        write()
    });
    settled.into_iter().try_for_each(|file| file.result).and(written)
}

fn write_report(folder: &OutputFolder, report: &RunReport) -> Result<(), OutputError> {
    let refused = |error: serde_json::Error| OutputError { path: folder.file(REPORT), source: error.into() };
    folder.write(REPORT, &report.to_json().map_err(refused)?)
}

/// What becomes of a file that could not be completed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum IfIncomplete {
    /// It can be read as far as it goes: it is kept, under a name that ends in `.partial`.
    Keep,
    /// It is of no use.
    Remove,
}

/// A file that is written during the run, under a temporary name.
#[derive(Debug, Clone)]
struct StreamedFile {
    partial: String,
    name: &'static str,
    if_incomplete: IfIncomplete,
}

/// What became of a [`StreamedFile`].
struct Settled {
    /// Its name if it is incomplete and was kept.
    incomplete: Option<String>,
    result: Result<(), OutputError>,
}

impl StreamedFile {
    fn new(format: &dyn RecordingFormat) -> Self {
        let (name, if_incomplete) = (format.file_name(), format.if_incomplete());
        Self { partial: format!("{name}.partial"), name, if_incomplete }
    }

    /// Gives the file its name if it is complete, at once: the page links to files that are there. `Err` also if it was
    /// complete and cannot be named, as when it was removed during the run.
    fn settle(
        self,
        folder: &OutputFolder,
        closed: Result<(), RecordingError>,
        settled: &mut Vec<Settled>,
    ) -> Result<(), RecordingError> {
        let is_complete = closed.is_ok();
        let file = match self.if_incomplete {
            _ if is_complete => {
                Settled { incomplete: None, result: folder.publish(&self.partial, self.name) }
            }
            IfIncomplete::Keep => Settled { incomplete: Some(self.partial), result: Ok(()) },
            IfIncomplete::Remove => Settled { incomplete: None, result: folder.remove(&self.partial) },
        };
        let named = file.result.as_ref().map_err(|error| RecordingError { message: error.to_string() });
        let named = if is_complete { named.copied() } else { Ok(()) };
        settled.push(file);
        closed.and(named)
    }
}
