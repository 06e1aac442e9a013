//! Who answers the samples of a run while it goes on.

use congruent_monitors::{Names, RecordingError, RunningCheck, Sample};

/// Sees each sample behind the recorders, with the checks that have judged it.
pub trait RunObserver {
    /// Sees one instant.
    ///
    /// # Errors
    /// [`RecordingError`] if the answer cannot be written; it ends the run.
    fn observe(
        &mut self,
        sample: &mut Sample<'_>,
        checks: &[RunningCheck<'_>],
        names: &Names,
    ) -> Result<(), RecordingError>;
}
