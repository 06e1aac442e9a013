//! The values that files have, around which values vary.

use std::path::Path;

use congruent_description::robot_numbers;
use congruent_input::{Diagnostic, FileAccess, Findings, NumberAt, Override};
use congruent_scenario::{ScenarioFile, robot_overrides, written_numbers};

/// The key of the robot's values.
const ROBOT: &str = "robot";

/// A scenario with the values that all cases have.
#[derive(Debug, Clone, Copy)]
pub(super) struct NominalValues<'a> {
    pub(super) scenario: &'a Path,
    pub(super) overrides: &'a [Override],
    pub(super) access: &'a FileAccess,
}

impl NominalValues<'_> {
    /// The numbers under a key, each with a key of its own; empty if no file has the key.
    pub(super) fn numbers(&self, key: &Override) -> Result<Vec<NumberAt>, Diagnostic> {
        let Self { scenario, overrides, access } = *self;
        let Some(of_robot) = key.inside(ROBOT) else {
            return written_numbers(scenario, overrides, key, access);
        };
        let numbers = || {
            let robot = ScenarioFile::read_with(scenario, overrides, access)?.robot_path();
            let access = access.inside_project_of(scenario)?;
            access.check(&robot)?;
            robot_numbers(&robot, &robot_overrides(overrides), &of_robot, &access)
        };
        let numbers = numbers().map_err(Findings::into_first)?;
        let outer = |number: NumberAt| NumberAt { key: format!("{ROBOT}.{}", number.key), ..number };
        Ok(numbers.into_iter().map(outer).collect())
    }
}
