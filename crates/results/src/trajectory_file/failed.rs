//! Errors of a table or a log as errors of the recording.

use congruent_monitors::RecordingError;

/// An error with the message of another.
pub(super) fn failed(error: impl std::fmt::Display) -> RecordingError {
    RecordingError { message: format!("the trajectory: {error}") }
}
