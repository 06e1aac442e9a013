//! From a path to a [`RobotDescription`]: decides which files are opened.

use std::{
    collections::{BTreeMap, BTreeSet},
    ops::Range,
    path::{Path, PathBuf},
    sync::Arc,
};

use toml::Spanned;

use crate::{
    Robot, RobotDescription, Tolerance,
    diagnostic::{Diagnostic, SourceFile},
    diagnostics::Diagnostics,
    file::read_text,
    mesh::MeshStore,
    model::link::LinkIndex,
    packages::Packages,
    robot_file::{self, Declared, ROBOT_FILE, ROBOT_FILE_BYTES, WrittenRobot},
    srdf::{self, SRDF_BYTES},
    urdf::{self, URDF_BYTES},
    written::toml_text::parse_toml,
};

const ACCEPTED: &str = "give a folder with robot.toml, a robot file (.toml) or a .urdf";

/// Loads a robot: a folder with `robot.toml`, that file under any name, or a bare `.urdf`.
///
/// A bare URDF has its root as base, the leaf of its longest chain of moving joints as tip, and no
/// Denavit-Hartenberg table.
///
/// # Errors
/// Every diagnostic, errors and warnings, when at least one is an error.
pub fn load_robot(path: &Path) -> Result<RobotDescription, Vec<Diagnostic>> {
    let name = path.display();
    if path.is_dir() {
        let robot_file = path.join(ROBOT_FILE);
        if !robot_file.exists() {
            let message = format!("{name} is a directory without a {ROBOT_FILE}");
            return Err(vec![Diagnostic::error("load::no_robot_file", message).with_help(ACCEPTED)]);
        }
        return load_robot_file(&robot_file);
    }
    if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml")) {
        load_robot_file(path)
    } else {
        load_bare_urdf(path)
    }
}

fn open(path: &Path, most_bytes: u64) -> Result<Arc<SourceFile>, Vec<Diagnostic>> {
    read_text(path, most_bytes).map_err(|fault| {
        let is_missing = fault.code == "file::not_found";
        vec![if is_missing { fault.with_help(ACCEPTED) } else { fault }]
    })
}

fn load_bare_urdf(path: &Path) -> Result<RobotDescription, Vec<Diagnostic>> {
    let (robot, warnings) = load_urdf(path, BTreeMap::new())?;
    let base = robot.root();
    let tip = robot.tip_of_longest_chain(base);
    Ok(RobotDescription {
        path: path.to_owned(),
        name: robot.name().to_owned(),
        urdf_path: path.to_owned(),
        robot,
        base,
        tip,
        dh: None,
        tip_from_tcp: None,
        tolerance: Tolerance::default(),
        disabled_collisions: BTreeSet::new(),
        warnings,
    })
}

fn load_urdf(
    path: &Path,
    declared: BTreeMap<String, PathBuf>,
) -> Result<(Robot, Vec<Diagnostic>), Vec<Diagnostic>> {
    let source = open(path, URDF_BYTES)?;
    let packages = Packages::new(parent(path), declared).map_err(|error| {
        let message = format!("{}: its folder cannot be read: {error}", path.display());
        vec![Diagnostic::error("file::unreadable", message)]
    })?;
    let mut meshes = MeshStore::new(&packages);
    let mut diagnostics = Diagnostics::default();
    let robot = urdf::parse(&source.text, &mut |uri, scale| meshes.find(uri, scale), &mut diagnostics);
    let diagnostics = diagnostics.in_file(&source);
    robot.map(|robot| (robot, diagnostics.clone())).ok_or(diagnostics)
}

/// The folder of a file; a bare file name is in the current one.
fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

fn load_robot_file(path: &Path) -> Result<RobotDescription, Vec<Diagnostic>> {
    let source = open(path, ROBOT_FILE_BYTES)?;
    let mut diagnostics = Diagnostics::default();
    let description = read_robot_file(path, &source.text, &mut diagnostics);
    let is_refused = diagnostics.has_error();
    let diagnostics = diagnostics.in_file(&source);
    match description {
        Some(description) if !is_refused => Ok(RobotDescription { warnings: diagnostics, ..description }),
        _ => Err(diagnostics),
    }
}

/// Everything about the robot file at `path`; its warnings are in `diagnostics`.
fn read_robot_file(path: &Path, text: &str, diagnostics: &mut Diagnostics) -> Option<RobotDescription> {
    let (written, urdf_path) = written_robot(path, text, diagnostics)?;
    let declared_packages = declared_packages(&written, parent(path), diagnostics);
    let robot = match load_urdf(&urdf_path, declared_packages) {
        Ok((robot, warnings)) => {
            diagnostics.extend(warnings);
            robot
        }
        Err(faults) => {
            let urdf = written.urdf.as_ref().map_or(0..0, Spanned::span);
            diagnostics.extend(faults.into_iter().map(|fault| placed(fault, &urdf)));
            return None;
        }
    };
    let declared = robot_file::check(&written, text, &robot, diagnostics);
    let disabled_collisions = disabled_collisions(&written, parent(path), &robot, diagnostics);
    let Declared { base, tip, dh, tip_from_tcp, tolerance } = declared?;
    let name = written.name.map_or_else(|| robot.name().to_owned(), Spanned::into_inner);
    Some(RobotDescription {
        path: path.to_owned(),
        name,
        urdf_path,
        robot,
        base,
        tip,
        dh,
        tip_from_tcp,
        tolerance,
        disabled_collisions,
        warnings: Vec::new(),
    })
}

fn disabled_collisions(
    written: &WrittenRobot,
    folder: &Path,
    robot: &Robot,
    diagnostics: &mut Diagnostics,
) -> BTreeSet<(LinkIndex, LinkIndex)> {
    let Some(srdf) = &written.srdf else { return BTreeSet::new() };
    match read_text(&folder.join(srdf.get_ref()), SRDF_BYTES) {
        Ok(source) => {
            let (pairs, faults) = srdf::parse(&source, robot);
            diagnostics.extend(faults);
            pairs
        }
        Err(fault) => {
            diagnostics.push(placed(fault, &srdf.span()));
            BTreeSet::new()
        }
    }
}

/// A fault of a file without readable text is shown where the file is named.
fn placed(fault: Diagnostic, named_at: &Range<usize>) -> Diagnostic {
    if fault.source.is_some() { fault } else { fault.at(named_at.clone()) }
}

fn written_robot(path: &Path, text: &str, diagnostics: &mut Diagnostics) -> Option<(WrittenRobot, PathBuf)> {
    let written: WrittenRobot = parse_toml(text, diagnostics)?;
    let urdf = diagnostics.keep(written.urdf.as_ref().ok_or_else(|| {
        Diagnostic::error("robot_file::urdf", "the robot file has no key \"urdf\"")
            .at(0..0)
            .with_help("urdf = \"robot.urdf\", relative to the robot file")
    }))?;
    let urdf_path = parent(path).join(urdf.get_ref());
    if !urdf_path.exists() {
        let message =
            format!("urdf = \"{}\": {} does not exist", urdf.get_ref().display(), urdf_path.display());
        diagnostics.push(Diagnostic::error("file::not_found", message).at(urdf.span()));
        return None;
    }
    Some((written, urdf_path))
}

fn declared_packages(
    written: &WrittenRobot,
    folder: &Path,
    diagnostics: &mut Diagnostics,
) -> BTreeMap<String, PathBuf> {
    let mut resolve = |(name, written): (&String, &Spanned<PathBuf>)| {
        let path = folder.join(written.get_ref());
        let canonical = path.canonicalize().ok().filter(|path| path.is_dir());
        let folder = diagnostics.keep(canonical.ok_or_else(|| {
            let message = format!("package \"{name}\": {} is not a folder", path.display());
            Diagnostic::error("robot_file::package", message).at(written.span())
        }))?;
        Some((name.clone(), folder))
    };
    written.packages.iter().filter_map(&mut resolve).collect()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    const URDF: &str = "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='continuous'>\
                        <parent link='a'/><child link='b'/></joint></robot>";

    /// A folder with these files.
    fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in files {
            fs::write(folder.path().join(name), text).unwrap();
        }
        folder
    }

    #[track_caller]
    fn refused(path: &Path, message: &str) {
        let found = load_robot(path).unwrap_err();
        assert!(found[0].message.contains(message), "{found:#?}");
    }

    #[test]
    fn a_folder_a_robot_file_and_a_urdf_load() {
        let robot_file = "name = 'mine'\nurdf = 'r.urdf'\nsrdf = 'r.srdf'\npackages = { here = '.' }";
        let srdf = "<robot name='r'><disable_collisions link1='b' link2='a'/></robot>";
        let folder = folder(&[("robot.toml", robot_file), ("r.urdf", URDF), ("r.srdf", srdf)]);
        for path in [folder.path().to_owned(), folder.path().join("robot.toml")] {
            let loaded = load_robot(&path).unwrap();
            assert_eq!((loaded.name.as_str(), loaded.robot.name()), ("mine", "r"));
            assert_eq!(loaded.urdf_path, folder.path().join("r.urdf"));
            assert_eq!(loaded.disabled_collisions.len(), 1);
        }
        let bare = load_robot(&folder.path().join("r.urdf")).unwrap();
        assert_eq!((bare.name.as_str(), bare.robot.link(bare.tip).name.as_str()), ("r", "b"));
        assert_eq!(bare.dh, None);
    }

    #[test]
    fn warnings_and_errors_say_which_file() {
        let folder = folder(&[("robot.toml", "urdf = 'r.urdf'\ntip = 'c'"), ("r.urdf", URDF)]);
        let found = load_robot(folder.path()).unwrap_err();
        let place = |found: &Diagnostic| (found.source.as_ref().unwrap().path.clone(), found.code);
        let file = |name| folder.path().join(name);
        assert_eq!(
            found.iter().map(place).collect::<Vec<_>>(),
            [(file("robot.toml"), "robot_file::unknown_link"), (file("r.urdf"), "urdf::massless")]
        );
    }

    #[test]
    fn what_is_missing_is_named() {
        let empty = folder(&[("no_urdf.toml", "name = 'a'"), ("gone.toml", "urdf = 'gone.urdf'")]);
        refused(empty.path(), "is a directory without a robot.toml");
        refused(&empty.path().join("nowhere"), "nowhere does not exist");
        refused(&empty.path().join("no_urdf.toml"), "no key \"urdf\"");
        refused(&empty.path().join("gone.toml"), "gone.urdf does not exist");
        let folder = folder(&[
            ("robot.toml", "urdf = 'r.urdf'\nsrdf = 'r.srdf'\npackages = { p = 'nope' }"),
            ("r.urdf", URDF),
        ]);
        let found = load_robot(folder.path()).unwrap_err();
        let codes: Vec<&str> = found.iter().map(|found| found.code).collect();
        assert_eq!(codes, ["file::not_found", "robot_file::package", "urdf::massless"]);
    }
}
