//! Recorders get every sample of a run, as the checks do. A kind of recording implements [`Recorder`] and
//! `RecordingFormat` of crate `results`.

use crate::sample::Sample;

/// Why a recording cannot be written.
#[derive(Debug, thiserror::Error)]
#[error("recording failed: {message}")]
pub struct RecordingError {
    /// The message of the recorder.
    pub message: String,
}

/// Takes every sample of a run, and decides itself which to keep.
pub trait Recorder {
    /// Takes one instant.
    ///
    /// # Errors
    /// [`RecordingError`] if it cannot be written.
    fn record(&mut self, sample: &mut Sample<'_>) -> Result<(), RecordingError>;
}

/// Several recorders of one run, one after another; one that has failed ends the run.
#[derive(Default)]
pub struct Recorders<'a>(pub Vec<&'a mut dyn Recorder>);

impl std::fmt::Debug for Recorders<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Recorders").field(&self.0.len()).finish()
    }
}

impl Recorder for Recorders<'_> {
    fn record(&mut self, sample: &mut Sample<'_>) -> Result<(), RecordingError> {
        self.0.iter_mut().try_for_each(|recorder| recorder.record(sample))
    }
}

/// A recorder that keeps no sample.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoRecorder;

impl Recorder for NoRecorder {
    fn record(&mut self, _sample: &mut Sample<'_>) -> Result<(), RecordingError> {
        Ok(())
    }
}
