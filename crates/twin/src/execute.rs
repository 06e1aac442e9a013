//! One scenario from its file to its results on disk.

use std::path::PathBuf;

use crate::{
    monitor::Check,
    recorder::{NoRecorder, Recorder, RecordingError},
    report::{OutputError, OutputFolder, RunReport, write_junit},
    run::{Run, RunError},
    scenario::Scenario,
};

/// Where results go and which.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Options {
    /// The folder above the scenarios' own folders.
    pub out: PathBuf,
    /// Whether a recording is made.
    pub recording: bool,
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
    mut scenario: Scenario,
    options: &Options,
    progress: impl FnMut(u64),
) -> Result<(RunReport, OutputFolder), ExecuteError> {
    let folder = OutputFolder::create(&options.out, &scenario.name)?;
    folder.write("scenario.resolved.toml", scenario.resolved().as_bytes())?;
    let mut checks = std::mem::take(&mut scenario.checks);
    let cannot_run = |source: RunError| ExecuteError::CannotRun { scenario: scenario.name.clone(), source };
    let run = Run::new(&scenario).map_err(cannot_run)?;
    let sources = run.model().sources().to_vec();
    let mut recording = Recording::start(options, &folder, &run, (&scenario, &checks))?;
    let (outcome, result) = run.finish(&mut checks, recording.recorder(), progress);
    let mut report = RunReport::new(&scenario, &sources, outcome.clone(), result.as_ref().err());
    let mut published = Ok(());
    if let Err(error) = recording.finish(&report) {
        // What broke the run comes before what breaks with it.
        let first = result.err().unwrap_or(error.into());
        report = RunReport::new(&scenario, &sources, outcome, Some(&first));
        // On a full disk it stands in the way of the report, which matters more.
        published = folder.remove(PARTIAL);
    } else if options.recording && cfg!(feature = "recording") {
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

/// The recording of a run, or none.
enum Recording {
    None(NoRecorder),
    #[cfg(feature = "recording")]
    Rerun(Box<crate::recording::RerunRecorder>),
}

impl Recording {
    #[cfg_attr(
        not(feature = "recording"),
        expect(unused_variables, clippy::unnecessary_wraps, reason = "nothing is recorded")
    )]
    fn start(
        options: &Options,
        folder: &OutputFolder,
        run: &Run<'_>,
        (scenario, checks): (&Scenario, &[Check]),
    ) -> Result<Self, RecordingError> {
        #[cfg(feature = "recording")]
        if options.recording {
            let path = folder.file(PARTIAL);
            let (names, sources) = (run.names(), run.model().sources());
            let recorder = crate::recording::RerunRecorder::create(&path, scenario, names, sources)?;
            return Ok(Self::Rerun(Box::new(recorder.with_limits_of(checks))));
        }
        Ok(Self::None(NoRecorder))
    }

    fn recorder(&mut self) -> &mut dyn Recorder {
        match self {
            Self::None(recorder) => recorder,
            #[cfg(feature = "recording")]
            Self::Rerun(recorder) => &mut **recorder,
        }
    }

    #[cfg_attr(
        not(feature = "recording"),
        expect(unused_variables, clippy::unnecessary_wraps, reason = "nothing is recorded")
    )]
    fn finish(self, report: &RunReport) -> Result<(), RecordingError> {
        match self {
            Self::None(_) => Ok(()),
            #[cfg(feature = "recording")]
            Self::Rerun(recorder) => recorder.finish(report),
        }
    }
}
