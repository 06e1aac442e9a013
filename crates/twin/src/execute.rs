//! One scenario from its file to its results on disk.

use std::path::{Path, PathBuf};

use crate::{
    recorder::{NoRecorder, Recorder, RecordingError},
    report::{OutputError, OutputFolder, RunReport, write_junit},
    run::{Run, RunError},
    setup::RunSetup,
};

/// Where results go and which.
#[derive(Clone)]
pub struct Options<'a> {
    /// The folder above the scenarios' own folders.
    pub out: PathBuf,
    /// How a recording is made; `None` for none.
    pub recording: Option<&'a dyn RecordingFormat>,
}

/// A recording under way: it takes samples, and in the end the report.
pub trait Recording: Recorder {
    /// Adds what came out and closes the file.
    ///
    /// # Errors
    /// [`RecordingError`] if it cannot be written.
    fn finish(self: Box<Self>, report: &RunReport) -> Result<(), RecordingError>;
}

/// A kind of recording.
pub trait RecordingFormat: Sync {
    /// Makes the file of a run that is about to start.
    ///
    /// # Errors
    /// [`RecordingError`] if it cannot be written.
    fn begin(&self, path: &Path, run: &Run<'_>) -> Result<Box<dyn Recording>, RecordingError>;
}

impl std::fmt::Debug for Options<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Options")
            .field("out", &self.out)
            .field("recording", &self.recording.is_some())
            .finish()
    }
}

/// Why there is no report.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExecuteError {
    /// Results could not be written, as was found before the run.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The recording cannot be begun.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// Results cannot be written, now that they are there: the report is here instead.
    #[error("results of scenario \"{}\" are lost: {source}", .report.scenario)]
    Lost {
        /// What was found.
        report: Box<RunReport>,
        /// Why it is not on disk.
        source: OutputError,
    },
    /// The robot cannot be simulated as the scenario asks.
    #[error("scenario \"{scenario}\" cannot run: {source}")]
    CannotRun {
        /// The scenario.
        scenario: String,
        /// Why.
        source: RunError,
    },
}

/// Runs a scenario and writes its results; the report says how it went.
///
/// `progress` is told the number of steps taken.
///
/// # Errors
/// [`ExecuteError`] when there can be no report. A run that breaks on the way has one.
pub fn execute(
    setup: &RunSetup,
    options: &Options<'_>,
    progress: impl FnMut(u64),
) -> Result<(RunReport, OutputFolder), ExecuteError> {
    let folder = OutputFolder::create(&options.out, &setup.scenario.name)?;
    folder.write("scenario.resolved.toml", setup.scenario.to_toml().as_bytes())?;
    let mut checks = setup.checks();
    let cannot_run =
        |source: RunError| ExecuteError::CannotRun { scenario: setup.scenario.name.clone(), source };
    let run = Run::new(setup).map_err(cannot_run)?;
    let sources = run.model().sources().to_vec();
    let mut recording = match options.recording {
        Some(format) => Some(format.begin(&folder.file(PARTIAL), &run)?),
        None => None,
    };
    let mut nothing = NoRecorder;
    let recorder: &mut dyn Recorder = match &mut recording {
        Some(recording) => &mut **recording,
        None => &mut nothing,
    };
    let (outcome, result) = run.finish(&mut checks, recorder, progress);
    let mut report = RunReport::new(setup, &sources, outcome.clone(), result.as_ref().err());
    let mut published = Ok(());
    let is_recorded = recording.is_some();
    if let Err(error) = recording.map_or(Ok(()), |recording| recording.finish(&report)) {
        // What broke the run comes before what breaks with it.
        let first = result.err().unwrap_or(error.into());
        report = RunReport::new(setup, &sources, outcome, Some(&first));
        // On a full disk it stands in the way of the report, which matters more.
        published = folder.remove(PARTIAL);
    } else if is_recorded {
        published = folder.publish(PARTIAL, "recording.rrd");
    }
    // Each is tried, whatever became of the others.
    let written = [
        published,
        folder.write_json("report.json", &report),
        write_junit(&folder.file("junit.xml"), std::slice::from_ref(&report)),
    ];
    match written.into_iter().collect() {
        Ok(()) => Ok((report, folder)),
        Err(source) => Err(ExecuteError::Lost { report: Box::new(report), source }),
    }
}

/// A recording under its temporary name.
const PARTIAL: &str = "recording.rrd.partial";
