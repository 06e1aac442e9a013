//! Which file the path of a robot means, and whether it is one.

use std::{
    ffi::OsStr,
    fs,
    path::{Path, PathBuf},
    sync::Arc,
};

use congruent_input::{
    Diagnostic, FileAccess, SourceFile, TextKind, TomlKind, direct_path, nearest, not_found,
};

use crate::{codes, robot_file::ROBOT_FILE};

const ACCEPTED: &str =
    "give a folder with robot.toml, a robot file (.toml), a URDF, an MJCF, or - for one on standard input";

/// The file that the path of a robot means: `robot.toml` in a folder, otherwise the path itself.
///
/// # Errors
/// The folder has no `robot.toml`.
pub fn file_of_robot(path: &Path) -> Result<PathBuf, Diagnostic> {
    if !path.is_dir() {
        return Ok(path.to_owned());
    }
    let robot_file = path.join(ROBOT_FILE);
    if robot_file.exists() {
        return Ok(robot_file);
    }
    let message = format!("{} is a directory without a {ROBOT_FILE}", path.display());
    let has_robots = fs::read_dir(path)
        .is_ok_and(|entries| entries.flatten().any(|entry| entry.path().join(ROBOT_FILE).is_file()));
    let help = if has_robots {
        format!("for the robots in it: {}", path.join("*/").display())
    } else if let Some(file) = robot_file_below(path).or_else(|| urdf_below(path)) {
        match file.parent().map(urdfs_in).unwrap_or_default() {
            2.. if is_urdf(&file) => format!("give one of {}", file.with_file_name("*.urdf").display()),
            _ => format!("it has {}: give that file", direct_path(&file).display()),
        }
    } else if find_below(path, 0, &is_toml).is_some() {
        format!("for the files in it: {}", path.join("*.toml").display())
    } else {
        ACCEPTED.to_owned()
    };
    Err(Diagnostic::error(codes::load::NO_ROBOT_FILE, message).with_help(help))
}

/// Folders below a named one in which a file is searched. Kind: choice; a package has its URDF in urdf/ or robots/urdf/.
const SEARCHED_DEPTH: usize = 2;
/// Most entries of a folder that are looked at. Kind: choice; a message must not take long.
const MOST_ENTRIES: usize = 200;

/// A robot file in a folder or below it: it says more than the URDF that it names.
fn robot_file_below(folder: &Path) -> Option<PathBuf> {
    find_below(folder, SEARCHED_DEPTH, &|path| path.file_name().is_some_and(|name| name == ROBOT_FILE))
}

/// A URDF in a folder or below it.
fn urdf_below(folder: &Path) -> Option<PathBuf> {
    find_below(folder, SEARCHED_DEPTH, &is_urdf)
}

/// How many URDFs are in a folder.
fn urdfs_in(folder: &Path) -> usize {
    fs::read_dir(folder).into_iter().flatten().flatten().filter(|entry| is_urdf(&entry.path())).count()
}

/// A file of this name in a folder, below it, or below the folder above.
fn file_nearby(folder: &Path, name: &OsStr) -> Option<PathBuf> {
    let above = folder.join("..");
    let is_named = |path: &Path| path.file_name() == Some(name);
    find_below(folder, SEARCHED_DEPTH, &is_named).or_else(|| find_below(&above, SEARCHED_DEPTH, &is_named))
}

/// The first file in a folder, then in those below it, in the order of their names.
fn find_below(folder: &Path, depth: usize, is_wanted: &dyn Fn(&Path) -> bool) -> Option<PathBuf> {
    let entries = fs::read_dir(folder).ok()?.take(MOST_ENTRIES).flatten();
    let mut entries: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    entries.sort();
    let (folders, files): (Vec<_>, Vec<_>) = entries.into_iter().partition(|path| path.is_dir());
    let found = files.into_iter().find(|path| is_wanted(path));
    found.or_else(|| {
        let deeper = depth.checked_sub(1)?;
        folders.iter().find_map(|folder| find_below(folder, deeper, is_wanted))
    })
}

/// The file of the same name in the folder whose name is most like that of the missing one: `xarm7_gripper` for `xarm7`.
fn in_similar_folder(path: &Path) -> Option<PathBuf> {
    let (name, folder) = (path.file_name()?, path.parent()?);
    let (above, missing) = (folder.parent()?, folder.file_name()?.to_str()?);
    let entries = fs::read_dir(above).ok()?.take(MOST_ENTRIES).flatten();
    let has_file = |entry: &fs::DirEntry| entry.path().join(name).is_file();
    let mut names: Vec<String> =
        entries.filter(has_file).filter_map(|entry| entry.file_name().into_string().ok()).collect();
    names.sort();
    let near = nearest(missing, names.iter().map(String::as_str))?;
    Some(above.join(near).join(name))
}

/// A URDF or MJCF that is not where the robot file says: the help has a similar name, or the same name in another folder nearby.
pub(crate) fn urdf_not_found(key: &str, written: &Path, folder: &Path, access: &FileAccess) -> Diagnostic {
    if written.to_string_lossy().contains("://") {
        let message = format!("{key} = \"{}\" is no path", written.display());
        return Diagnostic::error(congruent_input::codes::file::NOT_FOUND, message).with_help(
            "package:// is for meshes in a URDF; give the path of the URDF, relative to this file",
        );
    }
    let path = folder.join(written);
    let fault = not_found(&path, &format!("{key} = \"{}\": ", written.display()));
    if fault.help.is_some() {
        return fault;
    }
    let found = in_similar_folder(&path);
    let found = found.or_else(|| written.file_name().and_then(|name| file_nearby(folder, name)));
    // What may not be opened is not named either.
    match found.filter(|found| access.check(found).is_ok()) {
        Some(found) => {
            let found = found.strip_prefix(folder).unwrap_or(&found).display();
            fault.with_help(format!("the path is relative to the robot file; did you mean {found}?"))
        }
        None => fault.with_help("the path is relative to the robot file"),
    }
}

/// Opens a file that a person gives as a robot. If it does not exist and no similar name does, the help lists what is accepted.
///
/// # Errors
/// The file cannot be read, may not be opened, or is longer than `most_bytes`.
pub fn open(path: &Path, access: &FileAccess, most_bytes: u64) -> Result<Arc<SourceFile>, Diagnostic> {
    let kind = if is_toml(path) { TextKind::RobotFile } else { TextKind::Robot };
    // A scenario may name it.
    access.read_named_text(path, most_bytes).and_then(|source| kind.check(source)).map_err(|fault| {
        let is_helpless = fault.code == congruent_input::codes::file::NOT_FOUND && fault.help.is_none();
        if is_helpless { fault.with_help(ACCEPTED) } else { fault }
    })
}

/// Refuses a scenario in the place of a robot file, before each of its keys is reported as unknown.
pub(crate) fn refuse_scenario(source: &SourceFile) -> Result<(), Diagnostic> {
    if !is_toml(&source.path) || TomlKind::from_text(&source.text) != Some(TomlKind::Scenario) {
        return Ok(());
    }
    let path = source.path.display();
    Err(Diagnostic::error(codes::load::SCENARIO, format!("{path} is a scenario, not a robot"))
        .with_help(format!("to run it: congruent run {path}")))
}

/// Refuses a text under another name than those of URDFs that is no XML: as a URDF it would be malformed, which it is not meant
/// to be.
pub(crate) fn refuse_other_text(source: &SourceFile) -> Result<(), Diagnostic> {
    let ending = source.path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let is_expected = ["toml", "urdf", "xacro", "xml", ""].contains(&ending.as_str());
    let text = source.text.trim_start_matches(['\u{feff}', ' ', '\t', '\r', '\n']);
    if is_expected || text.is_empty() || text.starts_with('<') {
        return Ok(());
    }
    let message = format!("{} is neither a robot file (.toml) nor a URDF", source.path.display());
    Err(Diagnostic::error(congruent_input::codes::xml::MALFORMED, message).with_help(ACCEPTED))
}

fn is_urdf(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "urdf")
}

pub(crate) fn is_toml(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"))
}
