//! Where samples go besides the checks. A new kind of recording is one file that implements
//! [`Recorder`], and a line where the run is set up.

use crate::sample::Sample;

/// Why a recording cannot be written.
#[derive(Debug, thiserror::Error)]
#[error("recording failed: {message}")]
pub struct RecordingError {
    /// What the recorder says.
    pub message: String,
}

/// Takes every sample of a run; decides itself which it keeps.
pub trait Recorder {
    /// Takes one instant.
    ///
    /// # Errors
    /// [`RecordingError`] when it cannot be written.
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
