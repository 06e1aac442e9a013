//! Recorders get every sample of a run, as the checks do. A kind of recording implements [`Recorder`] and
//! [`RecordingFormat`](crate::RecordingFormat).

use crate::sample::Sample;

/// Why a recording cannot be written.
#[derive(Debug, thiserror::Error)]
#[error("recording failed: {message}")]
pub struct RecordingError {
    /// The recorder's message.
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

/// Keeps nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoRecorder;

impl Recorder for NoRecorder {
    fn record(&mut self, _sample: &mut Sample<'_>) -> Result<(), RecordingError> {
        Ok(())
    }
}
