//! The recording of a stream, in a file of bounded size.

use std::{
    cell::RefCell,
    path::{Path, PathBuf},
    rc::Rc,
};

use congruent::{
    monitors::{RecordingError, Sample},
    recording::RerunFormat,
    results::{Recording, RecordingFormat, report::RunReport},
    twin::Run,
    watch::{RecordingFull, SharedOutput, WatchLine},
};

use crate::{
    failure::Failure,
    recording::{live::LiveFormat, viewer::Viewer},
    terminal::print::Printer,
};

/// Samples between two looks at the size of the file.
const LOOKS_EVERY: u64 = 256;
/// Bytes that are kept for verdict, layout and the list of contents at the end. The largest seen: 0.4 MB, of an arm with twelve links.
const END_BYTES: u64 = 1_000_000;

/// Whether a recording is written, and how large it may become.
#[derive(Debug, Clone, clap::Args)]
pub(super) struct RecordingArguments {
    /// Write a recording for the rerun viewer into this file.
    #[arg(long = "recording", value_name = "FILE.rrd")]
    file: Option<PathBuf>,
    /// Most MB of the recording, to within some 4 MB: then it takes no further sample; the run goes on, and its verdict is added at
    /// the end.
    #[arg(long, value_name = "MB", default_value_t = 1000, value_parser = clap::value_parser!(u32).range(1..))]
    recording_limit_mb: u32,
    /// Show the recording in the rerun viewer while it is written; the viewer stays open.
    #[arg(long, requires = "file")]
    view: bool,
}

/// A recording that was asked for.
pub(super) struct AskedRecording {
    format: Box<dyn RecordingFormat>,
    path: PathBuf,
    limit_mb: u32,
}

impl RecordingArguments {
    /// The recording, if one is asked for.
    pub(super) fn format(&self, printer: &Printer) -> Result<Option<AskedRecording>, Failure> {
        let Some(path) = self.file.clone() else { return Ok(None) };
        let format: Box<dyn RecordingFormat> = if self.view {
            let viewer = Viewer::find(None)?;
            printer.notes(viewer.remark().as_deref());
            Box::new(LiveFormat(viewer))
        } else {
            Box::new(RerunFormat)
        };
        Ok(Some(AskedRecording { format, path, limit_mb: self.recording_limit_mb }))
    }
}

/// A recording that takes samples until its file has the wanted size.
pub(super) struct WatchRecording {
    recording: Box<dyn Recording>,
    path: PathBuf,
    limit_mb: u32,
    /// Bytes of the file at the last look, and the most that came between two looks.
    size_before: u64,
    largest_batch: u64,
    is_full: bool,
    output: SharedOutput,
}

/// The recording of a run, in its hands and in those of who finishes it.
pub(super) type SharedRecording = Rc<RefCell<Option<WatchRecording>>>;

impl WatchRecording {
    /// Creates the file.
    pub(super) fn begin(
        asked: AskedRecording,
        run: &Run<'_>,
        output: SharedOutput,
    ) -> Result<Self, RecordingError> {
        let AskedRecording { format, path, limit_mb } = asked;
        let recording = format.begin(&path, run)?;
        let size_before = size(&path);
        Ok(Self { recording, path, limit_mb, size_before, largest_batch: 0, is_full: false, output })
    }

    pub(super) fn record(&mut self, sample: &mut Sample<'_>) -> Result<(), RecordingError> {
        if self.is_full {
            return Ok(());
        }
        self.recording.record(sample)?;
        if !sample.step.is_multiple_of(LOOKS_EVERY) {
            return Ok(());
        }
        let size = size(&self.path);
        // What a batch has added so far, the next one may add as well, and the one that is not written yet.
        self.largest_batch = self.largest_batch.max(size - self.size_before.min(size));
        self.size_before = size;
        if size + 2 * self.largest_batch + END_BYTES > u64::from(self.limit_mb) * 1_000_000 {
            self.is_full = true;
            let mut output = self.output.borrow_mut();
            let (file, time_s) = (self.path.display().to_string(), output.time_s());
            output.say(&WatchLine::RecordingFull(RecordingFull { file, time_s, limit_mb: self.limit_mb }));
        }
        Ok(())
    }

    /// Adds the verdict and closes the file.
    pub(super) fn finish(self, report: &RunReport) -> Result<(), RecordingError> {
        self.recording.finish(report)
    }
}

fn size(path: &Path) -> u64 {
    // A file that was removed has no size to bound.
    path.metadata().map_or(0, |metadata| metadata.len())
}
