//! What is fitted to a log.

use congruent_description::RobotDescription;
use congruent_scenario::Scenario;

/// A robot, and the scenario of a log without its poses.
pub(super) struct Replayed<'a> {
    pub(super) description: &'a RobotDescription,
    pub(super) scenario: &'a Scenario,
}
