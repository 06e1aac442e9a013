//! The robot that a file without one is of: among the other files of the call, or in the same folder.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use congruent_description::{Robot, RobotDescription, load_robot_with};
use congruent_input::{Diagnostic, FileAccess, SourceFile, TextKind};
use congruent_lint::{FileKind, FileToLint, robot_name};

use crate::codes;

/// Most URDFs of a folder that are searched. Kind: choice; a folder with more is not that of one robot.
const MOST_LOOKED_AT: usize = 100;
/// Largest URDF of a folder that is searched, in bytes.
const MOST_BYTES: u64 = 16 << 20;
const ROBOT_FILE: &str = "robot.toml";

/// The robots among the files of a call. What comes from a pipe can be read once, so none of these is one.
fn robots<'a>(
    path: &'a Path,
    others: &'a [PathBuf],
    access: &'a FileAccess,
) -> impl Iterator<Item = &'a PathBuf> {
    let is_robot = move |other: &&PathBuf| {
        let is_other = other.as_path() != path && (other.is_file() || other.is_dir());
        let opened = is_other.then(|| FileToLint::open(other, &access.fresh()));
        opened.is_some_and(|file| {
            file.is_ok_and(|file| matches!(file.kind, FileKind::Urdf | FileKind::Mjcf | FileKind::RobotFile))
        })
    };
    others.iter().filter(is_robot)
}

/// The robot of an SRDF: that of the same name in the call, else in the same folder, else the only one of the call. If there
/// is none, the finding that says so.
pub(crate) fn robot_of_srdf(
    path: &Path,
    source: &Arc<SourceFile>,
    others: &[PathBuf],
    access: &FileAccess,
) -> Result<Robot, Diagnostic> {
    let name = robot_name(&source.text).unwrap_or_default();
    let load = |path: &Path| load_robot_with(path, &access.fresh()).ok().map(|loaded| loaded.robot);
    let mut given: Vec<Robot> = robots(path, others, access).filter_map(|path| load(path)).collect();
    if let Some(same) = given.iter().position(|robot| robot.name() == name) {
        return Ok(given.swap_remove(same));
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if let Some(robot) = urdfs_named(&name, folder).iter().find_map(|path| load(path)) {
        return Ok(robot);
    }
    // The SRDF names another robot, which is a finding of its own.
    if given.len() == 1 {
        return Ok(given.swap_remove(0));
    }
    let message = format!(
        "the names of links and joints are not checked: there is no readable URDF of robot \"{name}\" beside the SRDF"
    );
    Err(Diagnostic::warning(codes::lint::NO_ROBOT, message).at(0..0).with_help(
        "give both in one call, `congruent lint robot.urdf robot.srdf`, or lint the robot file that names the SRDF",
    ))
}

/// The URDFs of a folder whose robot has this name, in the order of their names.
fn urdfs_named(name: &str, folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let is_urdf = |path: &PathBuf| path.extension().is_some_and(|end| end.eq_ignore_ascii_case("urdf"));
    let mut urdfs: Vec<PathBuf> = entries.filter(is_urdf).collect();
    urdfs.sort();
    urdfs.truncate(MOST_LOOKED_AT);
    let has_name = |path: &PathBuf| {
        // Nobody has named it, so that it may not be a pipe.
        FileAccess::default()
            .read_text(path, MOST_BYTES, TextKind::Robot)
            .is_ok_and(|urdf| robot_name(&urdf.text).as_deref() == Some(name))
    };
    urdfs.retain(has_name);
    urdfs
}

/// The robot of a table: the only one of the call, else that of the robot file in the same folder.
pub(crate) fn robot_of_table(
    path: &Path,
    others: &[PathBuf],
    access: &FileAccess,
) -> Result<RobotDescription, Diagnostic> {
    let given: Vec<&PathBuf> = robots(path, others, access).collect();
    let file = path.with_file_name(ROBOT_FILE);
    let robot = match given[..] {
        [only] => only,
        _ if file.is_file() => &file,
        _ => {
            let how_many = if given.is_empty() { "no robot is" } else { "several robots are" };
            let message = format!("{how_many} given for {}, so its joints are not known", path.display());
            return Err(Diagnostic::error(codes::lint::NO_ROBOT, message).with_help(
                "give its robot in the same call: `congruent lint robot.toml table.json`; `fk`, `ik` and `calibrate` \
                 check their tables as they read them",
            ));
        }
    };
    load_robot_with(robot, &access.fresh()).map_err(|_| {
        let message =
            format!("{} is not checked: its robot {} cannot be read", path.display(), robot.display());
        Diagnostic::error(codes::lint::NO_ROBOT, message).with_help("lint the robot first")
    })
}
