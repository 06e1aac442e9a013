//! One scenario from its file to its results on disk.

use std::{
    path::{Path, PathBuf},
    sync::atomic::AtomicBool,
};

use crate::{
    recorder::{Recorder, Recorders, RecordingError},
    report::{RunReport, explain, write_junit},
    results::{FolderError, OutputError, OutputFolder},
    run::{Run, RunError},
    scenario::TrajectoryFormat,
    setup::RunSetup,
    trajectory_file::TrajectoryRecorder,
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

/// A kind of recording.
pub trait RecordingFormat: Sync {
    /// Name of the file in the folder of the scenario.
    fn file_name(&self) -> &'static str;

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
    /// The recording cannot be created.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// Results cannot be written after the run: the report is here instead.
    #[error("results of scenario \"{}\" are lost: {source}", .report.scenario)]
    Lost {
        /// The report.
        report: Box<RunReport>,
        /// Why it could not be written.
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
    let folder = OutputFolder::create(&options.out, &setup.scenario.name, &setup.inputs)?;
    folder.write("scenario.resolved.toml", setup.scenario.to_toml().as_bytes())?;
    let mut checks = setup.checks();
    let cannot_run =
        |source: RunError| ExecuteError::CannotRun { scenario: setup.scenario.name.clone(), source };
    let run = Run::new(setup).map_err(cannot_run)?.interrupted_by(options.interrupt);
    let sources = run.model().sources().to_vec();
    let mut recordings = Vec::new();
    for format in &options.recordings {
        let file = StreamedFile::new(format.file_name());
        recordings.push((format.begin(&folder.file(&file.partial), &run)?, file));
    }
    let mut trajectory = Trajectory::begin(&folder, &run)?;
    let mut recorders = Recorders::default();
    recorders.0.extend(recordings.iter_mut().map(|(recording, _)| &mut **recording as &mut dyn Recorder));
    recorders.0.extend(trajectory.as_mut().map(|trajectory| &mut trajectory.recorder as &mut dyn Recorder));
    let (mut outcome, mut result) = run.finish(&mut checks, &mut recorders, progress);
    explain(setup, &mut outcome);
    let mut settled = Vec::new();
    if let Some(Trajectory { file, recorder }) = trajectory {
        let closed = recorder.finish();
        settled.push(file.settle(&folder, &closed));
        result = result.and(closed.map_err(RunError::from));
    }
    let mut report = RunReport::new(setup, &sources, outcome.clone(), result.as_ref().err());
    for (recording, file) in recordings {
        let closed = recording.finish(&report);
        settled.push(file.settle(&folder, &closed));
        if let Err(error) = closed {
            // The error of the run is reported before an error of the recording that follows from it.
            result = result.and(Err(error.into()));
            report = RunReport::new(setup, &sources, outcome.clone(), result.as_ref().err());
        }
    }
    // Each is tried, even if another has failed.
    let written = [
        settled.into_iter().collect(),
        folder.write_json("report.json", &report),
        write_junit(&folder.file("junit.xml"), &[report.test_suite()]),
    ];
    match written.into_iter().collect() {
        Ok(()) => Ok((report, folder)),
        Err(source) => Err(ExecuteError::Lost { report: Box::new(report), source }),
    }
}

/// A file that is written during the run, under a temporary name.
#[derive(Debug, Clone)]
struct StreamedFile {
    partial: String,
    name: &'static str,
}

impl StreamedFile {
    fn new(name: &'static str) -> Self {
        Self { partial: format!("{name}.partial"), name }
    }

    /// Gives the file its name if it is complete. Otherwise it is removed: on a full disk it takes the space of the
    /// report, which matters more.
    fn settle(&self, folder: &OutputFolder, closed: &Result<(), RecordingError>) -> Result<(), OutputError> {
        if closed.is_ok() { folder.publish(&self.partial, self.name) } else { folder.remove(&self.partial) }
    }
}

/// The trajectory in progress, if the scenario asks for one.
struct Trajectory {
    file: StreamedFile,
    recorder: TrajectoryRecorder,
}

impl Trajectory {
    fn begin(folder: &OutputFolder, run: &Run<'_>) -> Result<Option<Self>, RecordingError> {
        let Some(format) = run.setup().scenario.output.trajectory else { return Ok(None) };
        let file = StreamedFile::new(match format {
            TrajectoryFormat::Csv => "trajectory.csv",
            TrajectoryFormat::Parquet => "trajectory.parquet",
        });
        let recorder = TrajectoryRecorder::create(&folder.file(&file.partial), format, run)?;
        Ok(Some(Self { file, recorder }))
    }
}
