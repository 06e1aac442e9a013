//! A scenario from its file, with the robot that it names.

use std::path::Path;

use congruent_description::{RobotDescription, load_robot_set};
use congruent_input::{Diagnostic, Diagnostics, FileAccess, Findings, Override};
use congruent_logs::SurveyedLog;
use congruent_scenario::{ScenarioFile, ScenarioFolder, robot_overrides};

use super::{run_setup::RunSetup, written_at::WrittenAt};
use crate::codes;

/// Loads the robot of a scenario, with the overrides of its own values.
pub type LoadRobot<'a> = dyn Fn(&Path, &[Override], &FileAccess) -> Result<RobotDescription, Findings> + 'a;

/// What a scenario is loaded with, beside its file.
struct LoadParts<'a> {
    /// In place of the log of `[source]`.
    stream: Option<&'a SurveyedLog>,
    robot: &'a LoadRobot<'a>,
    /// The robot that the planner knows, if it is another one.
    known: Option<&'a RobotDescription>,
}

impl Default for LoadParts<'_> {
    fn default() -> Self {
        Self { stream: None, robot: &load_robot_set, known: None }
    }
}

impl RunSetup {
    /// Reads a scenario file and the robot that it names; `overrides` replace values of the file.
    ///
    /// # Errors
    /// Every finding, if at least one is an error.
    pub fn load(path: &Path, overrides: &[Override]) -> Result<Self, Findings> {
        Self::load_with(path, overrides, &FileAccess::default())
    }

    /// The same with more files that may be opened.
    ///
    /// # Errors
    /// As [`RunSetup::load`].
    pub fn load_with(path: &Path, overrides: &[Override], access: &FileAccess) -> Result<Self, Findings> {
        Self::load_for(path, overrides, access, &LoadParts::default())
    }

    /// The same for a stream in place of the log of `[source]`, of which `stream` says what its first messages have.
    ///
    /// # Errors
    /// As [`RunSetup::load`].
    pub fn load_live(
        path: &Path,
        overrides: &[Override],
        access: &FileAccess,
        stream: &SurveyedLog,
    ) -> Result<Self, Findings> {
        Self::load_for(path, overrides, access, &LoadParts { stream: Some(stream), ..LoadParts::default() })
    }

    /// The same with a robot from `robot`, which gets its path and the overrides of its own values: many cases of one scenario load
    /// each robot once. Motions are planned for the robot `known`, if one is given: the one that a planner knows.
    ///
    /// # Errors
    /// As [`RunSetup::load`].
    pub fn load_with_robot(
        path: &Path,
        overrides: &[Override],
        access: &FileAccess,
        robot: &LoadRobot<'_>,
        known: Option<&RobotDescription>,
    ) -> Result<Self, Findings> {
        Self::load_for(path, overrides, access, &LoadParts { robot, known, ..LoadParts::default() })
    }

    fn load_for(
        path: &Path,
        overrides: &[Override],
        access: &FileAccess,
        parts: &LoadParts<'_>,
    ) -> Result<Self, Findings> {
        let own = access.fresh();
        let loaded = Self::load_noting(path, overrides, &own, parts);
        // Also after an error: files that were read before it are inputs, too.
        access.add(&own.files());
        loaded
    }

    /// The same; `access` notes what is read.
    fn load_noting(
        path: &Path,
        overrides: &[Override],
        access: &FileAccess,
        parts: &LoadParts<'_>,
    ) -> Result<Self, Findings> {
        let file = ScenarioFile::read_with(path, overrides, access)?;
        // Only now is it known which project the scenario belongs to.
        let access = access.inside_project_of(path)?;
        let in_file = |findings: Vec<Diagnostic>| findings.into_iter().map(|finding| file.mark(finding));
        let robot = file.robot_path();
        let description = match access
            .check(&robot)
            .map_err(Findings::from)
            .and_then(|()| (parts.robot)(&robot, &robot_overrides(overrides), &access))
        {
            Ok(description) => description,
            Err(findings) => {
                let mut findings = robot_refused(&file, findings);
                findings.extend(file.findings().iter().cloned());
                // Without a robot nothing else can be checked; findings of the file itself are kept.
                return Err(findings);
            }
        };
        let folder = file.folder();
        let folder = ScenarioFolder { path: &folder, access: &access };
        let written = WrittenAt { place: file.place(), folder, stream: parts.stream, known: parts.known };
        let built = Self::build(file.scenario.clone(), description, written);
        let mut setup = match built {
            Ok(setup) if file.findings().is_empty() => setup,
            // The file has errors that the plain data does not show, such as unknown keys.
            Ok(_) => return Err(file.findings().to_vec().into()),
            Err(findings) => {
                let mut all = Diagnostics::default();
                all.extend(file.findings().iter().cloned().chain(in_file(findings.into_vec())));
                return Err(all.into());
            }
        };
        let mut warnings = Diagnostics::default();
        warnings.extend(in_file(std::mem::take(&mut setup.warnings)));
        setup.warnings = warnings.into_vec();
        setup.inputs = access.files();
        // Kept apart: another source of joint states runs in spite of them.
        setup.for_simulation = in_file(std::mem::take(&mut setup.for_simulation)).collect();
        setup.path = Some(path.to_owned());
        setup.overrides = overrides.iter().map(ToString::to_string).collect();
        Ok(setup)
    }
}

/// The findings about a robot that cannot be used, at the key that names it.
fn robot_refused(file: &ScenarioFile, mut findings: Findings) -> Findings {
    let at_key = |found: Diagnostic| file.mark(file.place().key("robot").mark(found));
    // A path that names nothing is one mistake, of the scenario: it needs no second finding.
    if findings.len() == 1 && findings.first().source.is_none() {
        return at_key(findings.into_first()).into();
    }
    let message = format!("robot \"{}\" cannot be used", file.scenario.robot);
    let refused = Diagnostic::error(codes::scenario::ROBOT, message).with_help(
        "`robot` is a folder with robot.toml, a robot file or a .urdf, relative to the scenario file",
    );
    findings.extend([at_key(refused)]);
    findings
}
