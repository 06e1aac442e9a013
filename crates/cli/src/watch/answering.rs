//! The run that judges a stream and answers it.

use std::{path::Path, rc::Rc};

use congruent::{
    input::Diagnostic,
    logs::{JointRowCounts, LiveReader},
    monitors::{Names, NoRecorder, RecordingError, RunningCheck, Sample},
    page::PageFormat,
    results::{
        ExecuteError, Options, execute_with,
        report::{RunReport, explain},
    },
    twin::{
        Run, RunError, RunObserver, RunSetup,
        source::{RecordedSource, StreamProgress},
    },
    watch::{Observation, SharedOutput, WatchLine, WatchObserver, WatchSetup},
};

use super::Arguments;
use crate::{failure::Failure, run::no_folder, terminal::print::Printer};

#[cfg(feature = "recording")]
use super::recording::{SharedRecording, WatchRecording};

/// A stream that was judged to its end.
pub(super) struct Judged {
    pub(super) report: RunReport,
    pub(super) counts: JointRowCounts,
    pub(super) exit_code: u8,
}

/// Judges a stream from its first message to its end, and says meanwhile what it finds.
pub(super) fn judge(
    arguments: &Arguments,
    watched: &WatchSetup,
    reader: LiveReader,
    output: &SharedOutput,
    printer: &Printer,
) -> Result<Judged, Failure> {
    let state = StreamProgress::default();
    let observation = Observation {
        output: Rc::clone(output),
        state: Rc::clone(&state),
        clock: reader.clock().clone(),
        pose_rate_hz: arguments.pose_rate_hz(),
    };
    #[cfg(feature = "recording")]
    let recording = SharedRecording::default();
    #[cfg(feature = "recording")]
    let format = arguments.recording.format(printer)?;
    #[cfg(not(feature = "recording"))]
    let _ = printer;
    let setup = &watched.setup;
    let begin = |setup| {
        let run = begin(setup, reader, &state)?;
        if let Some(recorded) = &watched.setup.recorded {
            output.borrow_mut().say(&WatchLine::Started(watched.start(recorded)));
        }
        #[cfg(feature = "recording")]
        if let Some(format) = format {
            *recording.borrow_mut() = Some(WatchRecording::begin(format, &run, Rc::clone(output))?);
        }
        Ok(run.observed_by(Box::new(Answering {
            observer: WatchObserver::new(observation, &watched.setup.description),
            #[cfg(feature = "recording")]
            recording: Rc::clone(&recording),
        })))
    };
    let report = match &arguments.out {
        Some(out) => written(out, setup, begin)?,
        None => unwritten(setup, begin)?,
    };
    let exit_code = report.exit_code;
    #[cfg(feature = "recording")]
    let exit_code = finished(recording.take(), &report).unwrap_or(exit_code);
    Ok(Judged { counts: state.get().counts, report, exit_code })
}

/// Adds the verdict to the recording; the exit code if that cannot be written.
#[cfg(feature = "recording")]
fn finished(recording: Option<WatchRecording>, report: &RunReport) -> Option<u8> {
    let error = recording?.finish(report).err()?;
    let failure = Failure::Machine(error.to_string());
    Printer::explain(None, &failure);
    Some(failure.exit_code())
}

/// The run of a stream, at its first sample.
fn begin<'a>(setup: &'a RunSetup, reader: LiveReader, state: &StreamProgress) -> Result<Run<'a>, RunError> {
    let recorded = setup.recorded.as_ref().expect("the setup of a stream has what was found in it");
    let source =
        RecordedSource::live(recorded, &setup.description.robot, &setup.start, reader, Rc::clone(state))?;
    Run::with_source(setup, Box::new(source))
}

/// Judges and writes the results into the folder of `--out`.
fn written<'a>(
    out: &Path,
    setup: &'a RunSetup,
    begin: impl FnOnce(&'a RunSetup) -> Result<Run<'a>, RunError>,
) -> Result<RunReport, Failure> {
    let options = Options { out: out.to_owned(), recordings: vec![&PageFormat], interrupt: None };
    match execute_with(setup, &options, begin, explain, |_| ()) {
        Ok((report, _)) => Ok(report),
        Err(error @ ExecuteError::Lost { .. }) => Err(Failure::Machine(error.to_string())),
        Err(ExecuteError::Folder(error)) => Err(no_folder(error)),
        Err(ExecuteError::Output(error)) => Err(no_folder(error.into())),
        Err(error) => Err(cannot_run(&error)),
    }
}

/// Judges and writes nothing.
fn unwritten<'a>(
    setup: &'a RunSetup,
    begin: impl FnOnce(&'a RunSetup) -> Result<Run<'a>, RunError>,
) -> Result<RunReport, Failure> {
    let mut run = begin(setup).map_err(|error| cannot_run(&error))?;
    let sources = run.model().sources().to_vec();
    let (mut outcome, result) = run.finish(&mut setup.checks(), &mut NoRecorder, |_| ());
    let causes = explain(&mut run, &mut outcome);
    Ok(RunReport::new(setup, &sources, outcome, causes, result.as_ref().err()))
}

fn cannot_run(error: &dyn std::fmt::Display) -> Failure {
    let message = format!("the stream cannot be judged: {error}");
    Diagnostic::error(congruent::codes::run::CANNOT_RUN, message).into()
}

/// Records a sample and answers it.
struct Answering<'a> {
    observer: WatchObserver<'a>,
    #[cfg(feature = "recording")]
    recording: SharedRecording,
}

impl RunObserver for Answering<'_> {
    fn observe(
        &mut self,
        sample: &mut Sample<'_>,
        checks: &[RunningCheck<'_>],
        names: &Names,
    ) -> Result<(), RecordingError> {
        // The answer first: writing a batch of a recording takes a while.
        self.observer.observe(sample, checks, names)?;
        #[cfg(feature = "recording")]
        if let Some(recording) = &mut *self.recording.borrow_mut() {
            recording.record(sample)?;
        }
        Ok(())
    }
}
