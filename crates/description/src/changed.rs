//! The robots to check after files of a repository have changed: a URDF is a part of each robot file that names it.

use std::{
    fs,
    path::{Path, PathBuf},
};

use congruent_input::{FileAccess, TextKind};
use toml::{Table, Value};

use crate::robot_file::{ROBOT_FILE, ROBOT_FILE_BYTES};

/// Folders below the one that is searched. Kind: choice; deeper trees are built or downloaded, and not written by people.
const MOST_DEPTH: usize = 12;

/// The robots of files that changed, in their order and each once: for a URDF the robot files `robot.toml` below
/// `folder` that name it, for any other file and for a URDF that none of them names the file itself.
pub fn robots_of_changed(changed: &[PathBuf], folder: &Path) -> Vec<PathBuf> {
    let is_urdf = |path: &Path| path.extension().is_some_and(|end| end.eq_ignore_ascii_case("urdf"));
    let mut named = Vec::new();
    if changed.iter().any(|path| is_urdf(path)) {
        urdfs_named_below(folder, MOST_DEPTH, &mut named);
    }
    let mut robots: Vec<PathBuf> = Vec::new();
    let mut add = |path: &Path| {
        let is_known = robots.iter().any(|known| is_same(known, path));
        if !is_known {
            robots.push(path.to_owned());
        }
    };
    for path in changed {
        let mut is_named = false;
        for (robot_file, _) in named.iter().filter(|(_, urdf)| is_urdf(path) && is_same(urdf, path)) {
            is_named = true;
            add(robot_file);
        }
        if !is_named {
            add(path);
        }
    }
    robots
}

/// Whether two paths are one file, whatever links lead to it.
fn is_same(a: &Path, b: &Path) -> bool {
    a == b || a.canonicalize().is_ok_and(|a| b.canonicalize().is_ok_and(|b| a == b))
}

/// Each robot file in a folder and below it with the URDF that it names, in the order of their names. Hidden folders are
/// left out: they hold no sources.
fn urdfs_named_below(folder: &Path, depth: usize, found: &mut Vec<(PathBuf, PathBuf)>) {
    let is_here = folder == Path::new(".");
    let robot_file = if is_here { PathBuf::from(ROBOT_FILE) } else { folder.join(ROBOT_FILE) };
    if let Some(urdf) = urdf_named_in(&robot_file) {
        found.push((robot_file, urdf));
    }
    let Some(deeper) = depth.checked_sub(1) else { return };
    let mut names: Vec<_> =
        fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.file_name()).collect();
    names.sort();
    for name in names.iter().filter(|name| !name.to_string_lossy().starts_with('.')) {
        let below = if is_here { PathBuf::from(name) } else { folder.join(name) };
        // A link to a folder above would have no end.
        if below.is_dir() && !below.is_symlink() {
            urdfs_named_below(&below, deeper, found);
        }
    }
}

/// The URDF that a robot file names. One that cannot be read names none; if it has changed, it is checked itself.
fn urdf_named_in(robot_file: &Path) -> Option<PathBuf> {
    if !robot_file.is_file() {
        return None;
    }
    let source = FileAccess::default().read_text(robot_file, ROBOT_FILE_BYTES, TextKind::RobotFile).ok()?;
    let written: Table = source.text.parse().ok()?;
    let urdf = written.get("urdf").and_then(Value::as_str)?;
    Some(robot_file.parent()?.join(urdf))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_urdf_leads_to_the_robot_files_that_name_it() {
        let scratch = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| {
            let path = scratch.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(&path, text).unwrap();
            path
        };
        let urdf = write("description/urdf/arm.urdf", "<robot/>");
        let lone = write("description/urdf/lone.urdf", "<robot/>");
        let left = write("robots/left/robot.toml", "urdf = \"../../description/urdf/arm.urdf\"");
        let right = write("robots/right/robot.toml", "urdf = \"../../description/urdf/arm.urdf\"");
        write("robots/broken/robot.toml", "urdf = ");
        write(".hidden/robot.toml", "urdf = \"../description/urdf/arm.urdf\"");
        let check = |changed: &[&PathBuf], expected: &[&PathBuf]| {
            let changed: Vec<PathBuf> = changed.iter().map(|path| (*path).clone()).collect();
            let expected: Vec<PathBuf> = expected.iter().map(|path| (*path).clone()).collect();
            assert_eq!(robots_of_changed(&changed, scratch.path()), expected);
        };
        check(&[&urdf], &[&left, &right]);
        check(&[&right, &urdf], &[&right, &left]);
        check(&[&lone], &[&lone]);
    }
}
