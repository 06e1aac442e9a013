//! The trait of checks.

use super::names::Names;
use crate::{
    pose_sample::PoseSample,
    sample::Sample,
    verdict::{Contact, InstantValue, Measure, Moment},
};

/// A check that gets every sample of a run.
pub trait Monitor: Send {
    /// Evaluates the values of one sample.
    fn observe(&mut self, sample: &mut Sample<'_>);

    /// Evaluates a pose that the source has of the robot, at its own instant up to that of the sample which follows. Only checks of
    /// such poses do something with it.
    fn observe_pose(&mut self, _pose: &PoseSample<'_>) {}

    /// Evaluates what only the end of a run shows, at its last sample, which was observed before. A check calls it itself for a
    /// sample that is known to be the last; of a stream nobody knows it before.
    fn end(&mut self, _sample: &Sample<'_>) {}

    /// The results so far.
    fn finish(&self, names: &Names) -> Observed;

    /// Whether the check has failed already.
    fn has_failed(&self) -> bool;

    /// Calls `take` with each quantity that has a value at this time. Checks of the end of a run, and distances, which are
    /// measured only if they may be the smallest, have none.
    fn values(&self, _time_s: f64, _take: &mut dyn FnMut(InstantValue)) {}
}

/// The results of a monitor, without the check and the file that it belongs to.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Observed {
    /// Number of instants that were checked.
    pub samples: u64,
    /// Number of instants that could not be checked, with the reasons in `notes`.
    pub not_evaluated: u64,
    /// The quantities with their limits and worst values.
    pub measures: Vec<Measure>,
    /// The nearest pair whose distance changes, if that of the first measure does not.
    pub nearest_that_changes: Option<Moment>,
    /// The pairs that touched, with begin and end of each contact.
    pub contacts: Vec<Contact>,
    /// Remarks on the values.
    pub notes: Vec<String>,
}
