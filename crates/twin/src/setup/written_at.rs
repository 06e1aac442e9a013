//! Where a scenario is.

use congruent_description::RobotDescription;
use congruent_logs::SurveyedLog;
use congruent_scenario::{FilePlace, ScenarioFolder};

/// The place of a scenario in its file, and the folder of the files that it names.
#[derive(Debug, Clone, Copy)]
pub(super) struct WrittenAt<'a> {
    pub(super) place: FilePlace<'a>,
    pub(super) folder: ScenarioFolder<'a>,
    /// What the first messages of a stream say, which takes the place of the log.
    pub(super) stream: Option<&'a SurveyedLog>,
    /// The robot that the planner knows, if it is another one.
    pub(super) known: Option<&'a RobotDescription>,
}
