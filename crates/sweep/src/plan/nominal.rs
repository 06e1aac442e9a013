//! The values that files have, around which values vary.

use std::path::Path;

use congruent_description::{ROBOT_FILE_BYTES, Robot, load_robot_set};
use congruent_input::{
    Diagnostic, FileAccess, Findings, NumberAt, Override,
    codes::{cli::SET, toml::UNKNOWN_KEY},
    toml_text::parse_document,
};
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
            let (file, access) = self.file_and_access(overrides)?;
            robot_numbers(&file.robot_path(), &robot_overrides(overrides), &of_robot, &access)
        };
        let numbers = numbers().map_err(Findings::into_first)?;
        let outer = |number: NumberAt| NumberAt { key: format!("{ROBOT}.{}", number.key), ..number };
        Ok(numbers.into_iter().map(outer).collect())
    }

    /// The scenario file with these values, and what its robot may open, which may be opened itself.
    fn file_and_access(&self, overrides: &[Override]) -> Result<(ScenarioFile, FileAccess), Findings> {
        let file = ScenarioFile::read_with(self.scenario, overrides, self.access)?;
        let access = self.access.inside_project_of(self.scenario)?;
        access.check(&file.robot_path())?;
        Ok((file, access))
    }

    /// The finding about a key that no file may have; `None` if one may.
    pub(super) fn unknown_key(&self, key: &Override) -> Option<Diagnostic> {
        let overrides: Vec<Override> = self.overrides.iter().chain([key]).cloned().collect();
        let read = || {
            let (file, access) = self.file_and_access(&overrides)?;
            let robot = load_robot_set(&file.robot_path(), &robot_overrides(&overrides), &access);
            robot.map(|_| file.findings().to_vec())
        };
        let findings = read().unwrap_or_else(|findings: Findings| findings.into_iter().collect());
        findings.into_iter().find(|finding| [UNKNOWN_KEY, SET].contains(&finding.code))
    }
}

/// The numbers of a robot under a key: of its file, or of a link or joint. Empty if the robot file has no such key.
fn robot_numbers(
    path: &Path,
    overrides: &[Override],
    key: &Override,
    access: &FileAccess,
) -> Result<Vec<NumberAt>, Findings> {
    let loaded = load_robot_set(path, overrides, access)?;
    if Robot::has_value(key) {
        return Ok(loaded.robot.numbers_at(key)?);
    }
    if loaded.path.extension().is_none_or(|ending| ending != "toml") {
        let why = format!("{} is no robot file (robot.toml), which has such keys", loaded.path.display());
        return Err(key.refused(&why).into());
    }
    let text = access.read_named_text(&loaded.path, ROBOT_FILE_BYTES)?.text.clone();
    let of_file = overrides.iter().filter(|change| !Robot::has_value(change));
    let text = of_file.into_iter().try_fold(text, |text, change| change.edit_text(&text))?;
    Ok(key.numbers_in(&parse_document(&text)?)?)
}
