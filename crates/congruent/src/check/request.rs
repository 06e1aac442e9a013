//! What every caller of a check does before and after it: finds the other description by its name, and refuses what cannot be
//! checked. The command and the Python package share it.

use std::path::Path;

use congruent_agreement::compare::{Agreement, CheckError};
use congruent_description::{
    Robot, RobotDescription, codes::robot_file::INERTIAL, load_opened_robot, load_robot_set, load_robot_with,
};
use congruent_input::{
    Diagnostic, FileAccess, Findings, Override, RevisionName, Severity, absence, codes::file::NOT_FOUND,
    visible,
};
use congruent_logs::{RecordedDescription, is_log, recorded_description};

use super::robot_check::RobotCheck;
use crate::codes;

/// Who has named the other description of a check.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NamedBy {
    /// A `[[reference]]` of the robot file: with a fence it must be in the project.
    RobotFile,
    /// The caller, who may name any file.
    Caller,
}

/// The other description of a check: a path, a log with a recorded description, or `git:REV`; the mapping that the robot file declares for it is put into
/// `description`.
///
/// # Errors
/// The findings for which it cannot be read, or may not.
pub fn other_description(
    description: &mut RobotDescription,
    other: &Path,
    named_by: NamedBy,
    mut access: FileAccess,
) -> Result<RobotDescription, Findings> {
    let named = description.references.iter().find(|reference| reference.path == other).cloned();
    if let Some(reference) = named {
        if named_by == NamedBy::RobotFile {
            // It must be in the project, if all must.
            access = access.inside_project_of(&description.path)?;
            access.check(other)?;
        }
        description.mapping = reference.mapping;
    }
    refuse_bare_revision(other, &description.path, &access)?;
    if is_log(other) {
        return recorded(other, &access);
    }
    // Without a path it is the same robot in another revision.
    let revision = RevisionName::of(other).map(|name| name.beside(&description.path).to_path());
    load_robot_with(revision.as_deref().unwrap_or(other), &access)
}

/// The robot that was described while a log was recorded.
fn recorded(log: &Path, access: &FileAccess) -> Result<RobotDescription, Findings> {
    let RecordedDescription { source, warnings } = recorded_description(log)?;
    let mut description = load_opened_robot(&source, access)?;
    description.warnings.splice(0..0, warnings);
    Ok(description)
}

/// Refuses the name of a revision that is written without `git:`, as `HEAD~1`, if there is no such file.
fn refuse_bare_revision(other: &Path, robot: &Path, access: &FileAccess) -> Result<(), Diagnostic> {
    if other.exists() || RevisionName::of(other).is_some() {
        return Ok(());
    }
    let written = format!("git:{}", other.display());
    let revision = RevisionName::of(Path::new(&written)).map(|name| name.beside(robot).to_path());
    if revision.is_none_or(|revision| load_robot_with(&revision, access).is_err()) {
        return Ok(());
    }
    Err(Diagnostic::error(NOT_FOUND, absence(other))
        .with_help(format!("it is a revision of the repository: --against {written}")))
}

/// Why a robot cannot be checked; the path is the one that the caller gave.
pub fn cannot_be_checked(path: &Path, error: &CheckError) -> Diagnostic {
    let file = visible(&path.to_string_lossy()).into_owned();
    match error {
        CheckError::Mapping(why) => {
            let help = "correct [mapping] of the robot file, or name in left_out the joints that move in one file alone; \
                        without [mapping], `congruent check --against` finds the joints and prints the lines to declare";
            Diagnostic::error(codes::check::DECLARED_MAPPING, format!("{file}: {why}")).with_help(help)
        }
        error => Diagnostic::error(codes::check::ROBOT, format!("{file}: {error}")),
    }
}

/// Entries in frames that do not move with their joint, as errors: they refuse a check whose poses agree. They are warnings as
/// long as the table may be wrong, which the comparison of poses decides.
pub fn unusable_inertials(description: &RobotDescription) -> Vec<Diagnostic> {
    let of_inertials = description.warnings.iter().filter(|warning| warning.code == INERTIAL);
    of_inertials.map(|warning| Diagnostic { severity: Severity::Error, ..warning.clone() }).collect()
}

impl RobotCheck {
    /// Exit code of the command for this answer: 0 for agreement, 1 if something differs or fails by `--strict`, 2 if a part of a
    /// description cannot be read, 4 if nothing was compared.
    pub fn exit_code(&self) -> u8 {
        const FAILED: u8 = 1;
        const BAD_INPUT: u8 = 2;
        const NOTHING: u8 = 4;
        match self.geometry.verdict {
            Agreement::Agree if self.fails_by_lint() => FAILED,
            Agreement::Agree if self.fails_without_second() => NOTHING,
            Agreement::Agree => 0,
            Agreement::Disagree if self.is_unreadable() => BAD_INPUT,
            Agreement::Disagree => FAILED,
            Agreement::NothingCompared => NOTHING,
        }
    }
}

/// Loads a robot with other values than its file has, to be compared: by digits and lines of files, which a value of a link or joint has
/// not.
///
/// # Errors
/// As [`load_robot_set`], or a key is of a link or joint.
pub fn load_robot_file_set(
    path: &Path,
    overrides: &[Override],
    access: &FileAccess,
) -> Result<RobotDescription, Findings> {
    match overrides.iter().find(|change| Robot::has_value(change)) {
        None => load_robot_set(path, overrides, access),
        Some(change) => Err(change
            .refused("files are compared with their digits and lines, and this is a key of no file")
            .with_help(
                "set a key of robot.toml, such as dh.row.elbow_joint.d_m=0.4, or change a copy of the URDF",
            )
            .into()),
    }
}
