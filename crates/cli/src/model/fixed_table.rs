//! `check --fix`: writes the robot file with its cause corrected beside it, and checks what it has written.

use std::{
    fs,
    path::{Path, PathBuf},
};

use congruent::{RobotCheck, WrittenFix, agreement::compare::Agreement, description::RobotDescription};

use crate::{failure::Failure, output::file::NewFile};

/// Whether the corrected robot file is written.
#[derive(Debug, clap::Args)]
pub(super) struct FixArgument {
    /// Write the robot file with the cause corrected beside it (robot.toml: robot.fixed.toml) and check that file: the exit
    /// code is that of the second check. Nothing is written if no cause is in the robot file. An existing file is replaced
    /// only if it begins with the line that --fix writes first.
    #[arg(long, conflicts_with = "overrides")]
    pub(super) fix: bool,
}

/// The beginning of the first line of a file that `--fix` has written. A file without it is somebody's own.
const MARK: &str = "# Written by congruent check --fix";

/// Writes the corrected robot file, none of `inputs`, and gives the answer of its check, `again`; or says why there is none.
pub(super) fn fix(
    report: &RobotCheck,
    description: &RobotDescription,
    inputs: &[PathBuf],
    again: impl FnOnce(&Path) -> Result<RobotCheck, Failure>,
) -> Result<(WrittenFix, Option<RobotCheck>), Failure> {
    let corrected = report.diagnosis().and_then(|diagnosis| diagnosis.corrected.as_ref());
    let (Some(corrected), Some(places)) = (corrected, &description.places.robot_file) else {
        return Ok((
            WrittenFix { file: None, verdict: None, statement: why_nothing(report, description) },
            None,
        ));
    };
    let source = &places.source().path;
    let path = source.with_extension("fixed.toml");
    let is_own = || fs::read_to_string(&path).is_ok_and(|text| text.starts_with(MARK));
    if path.symlink_metadata().is_ok() && !is_own() {
        let path = path.display();
        return Ok((nothing(format!("{path} exists and is not of --fix: rename or remove it")), None));
    }
    let name = source.file_name().unwrap_or_default().display();
    let text = corrected.text.strip_prefix(MARK).and_then(|rest| rest.split_once('\n')).map(|(_, rest)| rest);
    let text = text.unwrap_or(&corrected.text);
    let text = format!("{MARK} from {name}; without this line --fix does not replace the file\n{text}");
    let file = NewFile { option: "--fix", path: &path, force: true };
    let fixed = file.write(&text, inputs, again)?;
    let statement = fixed.headline().to_string();
    let fix = WrittenFix {
        file: Some(path.display().to_string()),
        verdict: Some(fixed.geometry.verdict),
        statement,
    };
    Ok((fix, Some(fixed)))
}

fn nothing(statement: String) -> WrittenFix {
    WrittenFix { file: None, verdict: None, statement }
}

/// Why there is no corrected robot file.
fn why_nothing(report: &RobotCheck, description: &RobotDescription) -> String {
    if description.places.robot_file.is_none() {
        return "there is no robot file to correct".to_owned();
    }
    match report.geometry.verdict {
        Agreement::Agree | Agreement::NothingCompared => {
            return "no difference is to be corrected".to_owned();
        }
        Agreement::Disagree => {}
    }
    if !report.geometry.poses_disagree() {
        return "the table agrees; the difference is in dynamics".to_owned();
    }
    match report.diagnosis().and_then(|diagnosis| diagnosis.causes.first()) {
        Some(cause) if !cause.stages.is_empty() => {
            format!("a robot file cannot hold the correction of this cause: {}", cause.fault.message)
        }
        _ => "no known cause explains the difference".to_owned(),
    }
}
