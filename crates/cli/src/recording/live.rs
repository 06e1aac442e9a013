//! `run --view`: the recording of a run in the viewer while the run goes on. The viewer reads the file as it grows, through
//! its standard input; rerun's own connection would bring a network stack with an asynchronous runtime.

use std::{
    fs::File,
    io::{self, Read, Write},
    path::Path,
    process::Child,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    thread::{self, JoinHandle},
    time::Duration,
};

use congruent::{
    monitors::{Recorder, RecordingError, Sample},
    recording::RerunFormat,
    results::{IfIncomplete, Recording, RecordingFormat, report::RunReport},
    twin::Run,
};

use super::viewer::Viewer;
use crate::{failure::Failure, terminal::print::Printer};

/// Between two looks whether the file has grown.
const PAUSE: Duration = Duration::from_millis(50);

/// Recordings that are shown while they are written. The first is shown: a call with `--view` has one scenario.
#[derive(Debug)]
pub(crate) struct LiveFormat(pub(crate) Viewer);

/// A recording with the thread that shows it.
struct LiveRecording {
    recording: Box<dyn Recording>,
    viewer: Child,
    is_complete: Arc<AtomicBool>,
    copying: JoinHandle<()>,
}

impl RecordingFormat for LiveFormat {
    fn file_name(&self) -> &'static str {
        RerunFormat.file_name()
    }

    fn if_incomplete(&self) -> IfIncomplete {
        IfIncomplete::Keep
    }

    fn begin(&self, path: &Path, run: &Run<'_>) -> Result<Box<dyn Recording>, RecordingError> {
        let failed = |error: io::Error| RecordingError { message: format!("cannot show it: {error}") };
        let recording = RerunFormat.begin(path, run)?;
        let file = File::open(path).map_err(failed)?;
        let mut viewer = self.0.live().map_err(failed)?;
        let is_complete = Arc::new(AtomicBool::new(false));
        let seen = Arc::clone(&is_complete);
        let input = viewer.stdin.take();
        // A viewer that is closed, or that has no display, does not end the run.
        let copying = thread::spawn(move || {
            if let Some(input) = input {
                let _ = copy(file, input, || seen.load(Ordering::Acquire));
            }
        });
        Ok(Box::new(LiveRecording { recording, viewer, is_complete, copying }))
    }
}

/// Copies a file that grows until it is complete and copied to its end.
fn copy(mut file: impl Read, mut input: impl Write, is_complete: impl Fn() -> bool) -> io::Result<()> {
    let mut buffer = vec![0; 1 << 16];
    loop {
        // Asked before the end is looked for: what is written later was there before the answer.
        let is_last = is_complete();
        match file.read(&mut buffer)? {
            0 if is_last => return input.flush(),
            0 => {
                input.flush()?;
                thread::sleep(PAUSE);
            }
            length => input.write_all(&buffer[..length])?,
        }
    }
}

impl Recorder for LiveRecording {
    fn record(&mut self, sample: &mut Sample<'_>) -> Result<(), RecordingError> {
        self.recording.record(sample)
    }
}

impl Recording for LiveRecording {
    fn finish(self: Box<Self>, report: &RunReport) -> Result<(), RecordingError> {
        let Self { recording, mut viewer, is_complete, copying } = *self;
        let result = recording.finish(report);
        // Release pairs with the acquire of the copying thread: it then finds all bytes that `finish` has written.
        is_complete.store(true, Ordering::Release);
        // The thread ends with the input of the viewer, which stays open.
        let _ = copying.join();
        if let Ok(Some(status)) = viewer.try_wait()
            && !status.success()
        {
            let message = format!("the viewer ended with {status}; the recording is still written");
            Printer::explain(None, &Failure::Machine(message));
        }
        result
    }
}

#[cfg(test)]
mod tests {
    use std::{cell::Cell, collections::VecDeque};

    use super::*;

    /// A file that has nothing new at some reads.
    struct Growing(VecDeque<&'static [u8]>);

    impl Read for Growing {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            let part = self.0.pop_front().unwrap_or_default();
            buffer[..part.len()].copy_from_slice(part);
            Ok(part.len())
        }
    }

    #[test]
    fn what_is_written_before_the_end_is_copied() {
        let file = Growing([&b"head"[..], b"", b"body", b"", b"foot"].into());
        let (asked, mut copied) = (Cell::new(0), Vec::new());
        // Complete from the fifth look on: the last part is written just before.
        let is_complete = || {
            asked.set(asked.get() + 1);
            asked.get() >= 5
        };
        copy(file, &mut copied, is_complete).unwrap();
        assert_eq!(copied, b"headbodyfoot");
    }
}
