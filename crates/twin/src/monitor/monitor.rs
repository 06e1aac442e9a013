//! What every check does with a sample.

use super::names::Names;
use crate::{sample::Sample, verdict::Measure};

/// A check that looks at every sample of a run.
pub trait Monitor: Send {
    /// Looks at one instant.
    fn observe(&mut self, sample: &mut Sample<'_>);

    /// What was found so far.
    fn finish(&self, names: &Names) -> Observed;

    /// Whether the check has failed already.
    fn has_failed(&self) -> bool;
}

/// What a monitor found, before it is known which check of which file it belongs to.
#[derive(Debug, Clone, PartialEq)]
pub struct Observed {
    /// Instants looked at.
    pub samples: u64,
    /// The quantities with their limits.
    pub measures: Vec<Measure>,
    /// What to know beside the values.
    pub notes: Vec<String>,
}
