//! Where a scenario is.

use congruent_scenario::{FilePlace, ScenarioFolder};

/// The place of a scenario in its file, and the folder of the files that it names.
#[derive(Debug, Clone, Copy)]
pub(super) struct WrittenAt<'a> {
    pub(super) place: FilePlace<'a>,
    pub(super) folder: ScenarioFolder<'a>,
}
