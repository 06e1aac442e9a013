//! The robots to check after files of a repository have changed: a URDF is a part of each robot file that names it.

use std::{
    fs,
    path::{Path, PathBuf},
};

use congruent_description::{ROBOT_FILE, ROBOT_FILE_BYTES, URDF_BYTES, is_mjcf};
use congruent_input::{FileAccess, TextKind};
use toml::{Table, Value};

/// Folders below the one that is searched. Kind: choice; deeper trees are built or downloaded, and not written by people.
const MOST_DEPTH: usize = 12;

/// The keys of a robot file that name its URDF or MJCF.
const MODEL_KEYS: [&str; 2] = ["urdf", "description"];

/// What to check after files have changed.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ChangedRobots {
    /// The robots, in the order of the files and each once.
    pub robots: Vec<PathBuf>,
    /// The other files, each with the reason why there is nothing to check of it.
    pub ignored: Vec<(PathBuf, &'static str)>,
}

/// The robots of files that changed: for a URDF the robot files `robot.toml` below `folder` that name it, for a robot file, and
/// for a URDF that none of them names, the file itself. A repository passes all files of a change, of which many are no robots.
pub fn robots_of_changed(changed: &[PathBuf], folder: &Path) -> ChangedRobots {
    let why = |path: &PathBuf| Some((path.clone(), why_no_robot(path)?));
    let ignored: Vec<(PathBuf, &'static str)> = changed.iter().filter_map(why).collect();
    let is_robot = |path: &&PathBuf| ignored.iter().all(|(other, _)| other != *path);
    let changed: Vec<&PathBuf> = changed.iter().filter(is_robot).collect();
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
    for path in changed.into_iter().map(PathBuf::as_path) {
        let mut is_named = false;
        for (robot_file, _) in named.iter().filter(|(_, urdf)| is_urdf(path) && is_same(urdf, path)) {
            is_named = true;
            add(robot_file);
        }
        if !is_named {
            add(path);
        }
    }
    ChangedRobots { robots, ignored }
}

/// Whether a file is a URDF by its name, or an MJCF by its text.
fn is_urdf(path: &Path) -> bool {
    let ends = |ending| path.extension().is_some_and(|end| end.eq_ignore_ascii_case(ending));
    let is_mjcf = || {
        let source = FileAccess::default().read_text(path, URDF_BYTES, TextKind::Robot).ok();
        source.is_some_and(|source| is_mjcf(&source.text))
    };
    ends("urdf") || ends("xml") && is_mjcf()
}

/// Why a file of a change is no robot to check; `None` if it is one, or cannot be read, which the check then says.
fn why_no_robot(path: &Path) -> Option<&'static str> {
    if !path.exists() {
        return Some("it does not exist");
    }
    let is_toml = path.extension().is_some_and(|end| end.eq_ignore_ascii_case("toml"));
    if is_urdf(path) || path.is_dir() || path.file_name().is_some_and(|name| name == ROBOT_FILE) {
        return None;
    }
    let is_robot_file = || {
        let text = FileAccess::default().read_text(path, ROBOT_FILE_BYTES, TextKind::RobotFile).ok();
        text.is_some_and(|source| source.text.lines().any(is_line_of_robot_file))
    };
    (!is_toml || !is_robot_file()).then_some("it is neither a robot file nor a URDF")
}

/// Whether a line is one that robot files have and other files in TOML do not: the model, the table or the screws.
fn is_line_of_robot_file(line: &str) -> bool {
    let line = line.trim_start();
    let is_key = |key: &str| line.strip_prefix(key).is_some_and(|rest| rest.trim_start().starts_with('='));
    let begins = ["[dh]", "[dh.", "[[dh.", "dh.", "[poe]", "[[poe."];
    MODEL_KEYS.iter().any(|key| is_key(key)) || begins.iter().any(|start| line.starts_with(start))
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
    let urdf = MODEL_KEYS.iter().find_map(|key| written.get(*key)).and_then(Value::as_str)?;
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
            assert_eq!(robots_of_changed(&changed, scratch.path()).robots, expected);
        };
        check(&[&urdf], &[&left, &right]);
        check(&[&right, &urdf], &[&right, &left]);
        check(&[&lone], &[&lone]);
        // A robot file has any name, and the other files of a commit are no robots.
        let named = write("robots/cell/left_arm.toml", "urdf = \"arm.urdf\"");
        let others = [write("README.md", "# Arms"), write("pyproject.toml", "packages = [\"arm\"]")];
        let gone = scratch.path().join("gone.urdf");
        check(&[&named, &others[0], &others[1], &gone], &[&named]);
        let ignored = robots_of_changed(&[others[1].clone(), gone.clone()], scratch.path()).ignored;
        let not_a_robot = (others[1].clone(), "it is neither a robot file nor a URDF");
        assert_eq!(ignored, [not_a_robot, (gone, "it does not exist")]);
    }
}
