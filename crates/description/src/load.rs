//! Loads a [`RobotDescription`] from a path: decides which files are opened, and in which order they are checked.

use std::{
    collections::{BTreeMap, BTreeSet},
    ops::Range,
    path::{Path, PathBuf},
    sync::Arc,
};

use congruent_input::{
    Capability, Diagnostic, Diagnostics, FileAccess, Findings, RevisionFiles, RevisionName, SourceFile,
    TextKind, direct_path, folder_of,
};
use congruent_robot::{LinkIndex, Robot};
use toml::Spanned;

use crate::{
    chain::ChainEnd,
    codes,
    description::{NamedFiles, Places, RobotDescription},
    model_file::ModelFile,
    named_robot::{file_of_robot, is_toml, open, refuse_other_text, refuse_scenario, urdf_not_found},
    own_model::{OwnModel, TIP, is_own, own_model, refuse_beside_model},
    revision::as_named,
    robot_file::{
        self, DeclaredReference, InertialPlaces, ROBOT_FILE, ROBOT_FILE_BYTES, RobotFilePlaces, WrittenRobot,
    },
    srdf::{self, SRDF_BYTES},
    tolerance_scale::ToleranceScale,
    urdf::{Repairs, URDF_BYTES},
};

/// Loads a robot: a folder with `robot.toml`, that file under any name, or a bare URDF or MJCF, which may come from
/// a pipe, as `-` from standard input, or as `git:REV:PATH` from a revision in git. Which of the two it is, its root element says.
///
/// A bare URDF or MJCF has its root as base, the frame for tools at the end of its longest chain of moving joints (before
/// a gripper) as tip, and no Denavit-Hartenberg table.
///
/// A fault in a part that kinematics does not need, such as a missing mesh, is a warning here;
/// [`RobotDescription::check_capability`] refuses the use that needs the part.
///
/// # Errors
/// Every diagnostic, errors and warnings, if at least one is an error.
pub fn load_robot(path: &Path) -> Result<RobotDescription, Findings> {
    load_robot_with(path, &FileAccess::default())
}

/// The same with further files that may be opened, and with a record of the files that were read.
///
/// # Errors
/// As [`load_robot`].
pub fn load_robot_with(path: &Path, access: &FileAccess) -> Result<RobotDescription, Findings> {
    if let Some(name) = RevisionName::of(path) {
        // With the URDF, the includes and the meshes of the same revision.
        let files = RevisionFiles::read(&name, ROBOT_FILE)?;
        let own = access.fresh();
        let loaded = load_robot_with(&files.file(), &own);
        return as_named(loaded, own.files(), &files, access);
    }
    // A record of its own, so that `inputs` has the files of this robot only, whatever the caller has read before.
    let own = access.fresh();
    let loaded = load(path, &own);
    // Before `?`: files that were read by a load that failed are inputs of the caller, too.
    access.add(&own.files());
    Ok(RobotDescription { inputs: own.files(), ..loaded? })
}

fn load(path: &Path, access: &FileAccess) -> Result<RobotDescription, Findings> {
    let path = file_of_robot(path)?;
    let most_bytes = if is_toml(&path) { ROBOT_FILE_BYTES } else { URDF_BYTES };
    let source = open(&path, access, most_bytes)?;
    refuse_scenario(&source)?;
    refuse_other_text(&source)?;
    load_source(&source, access)
}

/// The same from a robot file, a URDF or an MJCF that was opened already.
///
/// # Errors
/// As [`load_robot`].
pub fn load_opened_robot(
    source: &Arc<SourceFile>,
    access: &FileAccess,
) -> Result<RobotDescription, Findings> {
    let own = access.fresh();
    let loaded = load_source(source, &own);
    let inputs = access.files().into_iter().chain(own.files()).collect();
    access.add(&own.files());
    Ok(RobotDescription { inputs, ..loaded? })
}

fn load_source(source: &Arc<SourceFile>, access: &FileAccess) -> Result<RobotDescription, Findings> {
    if is_toml(&source.path) { load_robot_file(source, access) } else { load_bare_model(source, access) }
}

/// The same from texts alone, whose paths only name them: nothing is opened.
///
/// Meshes cannot be found, so a URDF with meshes is refused for clearance, and an MJCF that includes files is refused; of the robot
/// file the keys `urdf`, `description`, `srdf` and `packages` are not followed.
///
/// # Errors
/// Every diagnostic, errors and warnings, if at least one is an error.
/// # Examples
/// ```
/// use congruent_description::parse_robot;
/// use congruent_input::SourceFile;
/// let source = |name: &str, text: &str| SourceFile { path: name.into(), text: text.into(), is_foreign: false }.into();
/// let urdf = source("stand.urdf", "<robot name='stand'><link name='base'/></robot>");
/// let robot_file = source("robot.toml", "name = 'mine'\ntip = 'tool'");
/// assert_eq!(parse_robot(None, &urdf).unwrap().name, "stand");
/// let refused = parse_robot(Some(&robot_file), &urdf).unwrap_err();
/// assert_eq!(refused[0].line_column(), Some((2, 7)));
/// ```
pub fn parse_robot(
    robot_file: Option<&Arc<SourceFile>>,
    urdf: &Arc<SourceFile>,
) -> Result<RobotDescription, Findings> {
    let Some(robot_file) = robot_file else {
        return Ok(bare(urdf, ModelFile::parse(urdf, &Repairs::default())?));
    };
    let mut diagnostics = Diagnostics::default();
    // Unknown keys are faults but still give a value, so that the URDF and the names are checked in the same run.
    let written: Option<WrittenRobot> = robot_file::parse(&robot_file.text, &mut diagnostics);
    let declared = written.and_then(|written| {
        refuse_beside_model(&written, &mut diagnostics);
        let repairs = written.repairs(robot_file);
        // Faults of both files are collected, since each must be corrected anyway.
        let mut model = ModelFile::parse(urdf, &repairs).map_err(|faults| diagnostics.extend(faults)).ok()?;
        diagnostics.extend(std::mem::take(&mut model.warnings));
        declared(written, robot_file, urdf, model, &mut diagnostics)
    });
    checked(declared, diagnostics, robot_file)
}

fn load_bare_model(source: &Arc<SourceFile>, access: &FileAccess) -> Result<RobotDescription, Findings> {
    let model = ModelFile::load(source, BTreeMap::new(), access, &Repairs::default())?;
    let named_files = NamedFiles { packages: access.packages().clone(), ..NamedFiles::default() };
    Ok(RobotDescription { named_files, ..bare(source, model) })
}

/// The description of a bare URDF or MJCF: root as base, a chosen tip, no table, default tolerance.
fn bare(source: &Arc<SourceFile>, model: ModelFile) -> RobotDescription {
    let ModelFile { robot, warnings, excluded, places } = model;
    let alone = RobotDescription::of_robot(&source.path, robot);
    RobotDescription { disabled_collisions: excluded, warnings, places, ..alone }.with_tip_warning()
}

fn load_robot_file(source: &Arc<SourceFile>, access: &FileAccess) -> Result<RobotDescription, Findings> {
    let mut diagnostics = Diagnostics::default();
    let access = access.inside_project_of(&source.path)?;
    // The project of the robot file decides which files it may name; set once, it also holds for the URDF that it names.
    let description = read_robot_file(source, &access, &mut diagnostics);
    checked(description, diagnostics, source)
}

/// A description with its warnings, or every diagnostic if one is an error.
fn checked(
    description: Option<RobotDescription>,
    diagnostics: Diagnostics,
    robot_file: &Arc<SourceFile>,
) -> Result<RobotDescription, Findings> {
    // Decided before `in_file`, which consumes the diagnostics.
    let is_refused = diagnostics.has_error();
    let diagnostics = diagnostics.in_file(robot_file);
    match description {
        Some(description) if !is_refused => {
            Ok(RobotDescription { warnings: diagnostics, ..description }.with_tip_warning())
        }
        _ => Err(diagnostics.into()),
    }
}

/// Reads a robot file and the files that it names. The order is that of need: URDF or MJCF need packages and repairs, SRDF and
/// table need its links and joints.
fn read_robot_file(
    robot_file: &Arc<SourceFile>,
    access: &FileAccess,
    diagnostics: &mut Diagnostics,
) -> Option<RobotDescription> {
    let written: WrittenRobot = robot_file::parse(&robot_file.text, diagnostics)?;
    if is_own(&written) {
        return read_own_model(written, robot_file, diagnostics);
    }
    let urdf_path = model_path(&written, robot_file, access, diagnostics)?;
    refuse_beside_model(&written, diagnostics);
    let folder = folder_of(&robot_file.path);
    let packages = declared_packages(&written, folder, access, diagnostics);
    let named_files = NamedFiles {
        srdf: written.srdf.as_ref().map(|srdf| folder.join(srdf.get_ref())),
        packages: packages.clone(),
    };
    let repairs = written.repairs(robot_file);
    // If the URDF cannot be used, nothing after it can be checked: names of links and joints would all be unknown.
    let urdf = access.read_text(&urdf_path, URDF_BYTES, TextKind::Robot).map_err(Findings::from);
    let model = urdf.and_then(|urdf| Ok((ModelFile::load(&urdf, packages, access, &repairs)?, urdf)));
    let (mut model, urdf) = match model {
        Ok(read) => read,
        Err(faults) => {
            let urdf = written.model().map_or(0..0, |(_, path)| path.span());
            diagnostics.extend(faults.into_iter().map(|fault| placed(fault, &urdf)));
            return None;
        }
    };
    diagnostics.extend(std::mem::take(&mut model.warnings));
    let srdf = written.srdf.clone();
    let mut disabled_collisions =
        disabled_collisions(srdf.as_ref(), folder, access, &model.robot, diagnostics);
    disabled_collisions.extend(&model.excluded);
    let description = declared(written, robot_file, &urdf, model, diagnostics)?;
    Some(RobotDescription { named_files, disabled_collisions, ..description })
}

/// The description of a robot file whose table or screws are the robot.
fn read_own_model(
    mut written: WrittenRobot,
    robot_file: &Arc<SourceFile>,
    diagnostics: &mut Diagnostics,
) -> Option<RobotDescription> {
    let OwnModel { robot, places } = own_model(&written, robot_file, diagnostics)?;
    let is_tip_named = written.tip.is_some();
    // Given, because a choice would end the chain before a last joint that slides, as before a gripper.
    written.tip.get_or_insert_with(|| Spanned::new(0..0, TIP.to_owned()));
    let model =
        ModelFile { robot, warnings: Vec::new(), excluded: BTreeSet::new(), places: Places::default() };
    let mut own = declared(written, robot_file, robot_file, model, diagnostics)?;
    if !is_tip_named {
        own.chain_ends.tip = ChainEnd::Chosen;
    }
    own.places.own_model = Some(places);
    Some(own)
}

/// The description that follows from a robot file and its robot; the caller adds SRDF and warnings.
fn declared(
    written: WrittenRobot,
    robot_file: &Arc<SourceFile>,
    urdf: &Arc<SourceFile>,
    model: ModelFile,
    diagnostics: &mut Diagnostics,
) -> Option<RobotDescription> {
    let ModelFile { robot, excluded, places, .. } = model;
    let declared = robot_file::check(&written, &robot_file.text, &robot, diagnostics);
    let declared = declared?;
    // Only here is the reach known (tip and tool are resolved), with which a tolerance is compared.
    let scale = ToleranceScale::with_tool(&robot, declared.tip, declared.tip_from_tcp.as_ref());
    diagnostics.extend(written.tolerance.iter().flat_map(|tolerance| tolerance.examine(scale)));
    let tolerance_span = written.tolerance_span();
    let inertials = declared
        .dynamics
        .is_some()
        .then(|| Arc::new(InertialPlaces::new(Arc::clone(robot_file), written.dynamics, written.inertial)));
    let table =
        written.dh.map(|dh| Arc::new(RobotFilePlaces::new(Arc::clone(robot_file), dh, tolerance_span)));
    let folder = folder_of(&robot_file.path);
    let in_folder = |of: DeclaredReference| DeclaredReference { path: folder.join(&of.path), ..of };
    Some(RobotDescription {
        path: robot_file.path.clone(),
        name: written.name.map_or_else(|| robot.name().to_owned(), Spanned::into_inner),
        urdf_path: urdf.path.clone(),
        robot,
        base: declared.base,
        tip: declared.tip,
        chain_ends: declared.chain_ends,
        dh: declared.dh,
        dynamics: declared.dynamics,
        accelerations: declared.accelerations,
        tip_from_tcp: declared.tip_from_tcp,
        tolerance: declared.tolerance,
        declared_tolerance: declared.tolerance_parts,
        tolerances: declared.tolerances,
        mapping: declared.mapping,
        references: declared.references.into_iter().map(in_folder).collect(),
        named_files: NamedFiles::default(),
        disabled_collisions: excluded,
        warnings: Vec::new(),
        inputs: Vec::new(),
        places: Places { robot_file: table, inertials, ..places },
        set_values: Vec::new(),
        loaded: None,
    })
}

fn disabled_collisions(
    srdf: Option<&Spanned<PathBuf>>,
    folder: &Path,
    access: &FileAccess,
    robot: &Robot,
    diagnostics: &mut Diagnostics,
) -> BTreeSet<(LinkIndex, LinkIndex)> {
    let Some(srdf) = srdf else { return BTreeSet::new() };
    match access.read_text(&folder.join(srdf.get_ref()), SRDF_BYTES, TextKind::Robot) {
        Ok(source) => {
            let (pairs, faults) = srdf::parse(&source, robot);
            diagnostics.extend(faults);
            pairs
        }
        // Without an SRDF poses and forces are still right; distances would include pairs that it excludes.
        Err(fault) => {
            diagnostics.push(placed(fault, &srdf.span()).needed_by(Some(Capability::Clearance)));
            BTreeSet::new()
        }
    }
}

/// A fault of a file that has no readable text is placed at the key of the robot file that names it.
fn placed(fault: Diagnostic, named_at: &Range<usize>) -> Diagnostic {
    if fault.source.is_some() { fault } else { fault.at(named_at.clone()) }
}

/// The path of the URDF or MJCF that a robot file names.
fn model_path(
    written: &WrittenRobot,
    robot_file: &SourceFile,
    access: &FileAccess,
    diagnostics: &mut Diagnostics,
) -> Option<PathBuf> {
    // A misspelt [dh] is found already: the file then lacks no URDF.
    if written.model().is_none()
        && ["urdf", "description", "dh", "poe"].iter().any(|key| diagnostics.has_misspelt(key))
    {
        return None;
    }
    let (key, urdf) = diagnostics.keep(written.model().ok_or_else(|| {
        Diagnostic::error(codes::robot_file::URDF, "the robot file has no key \"urdf\"")
            .at(0..0)
            .with_help("urdf = \"robot.urdf\", or an MJCF (urdf = \"robot.xml\"), relative to the robot file; without one a table ([dh]) or screws ([poe]) are the robot")
    }))?;
    if let (Some(_), Some(description)) = (&written.urdf, &written.description) {
        let message = "the robot file has both keys \"urdf\" and \"description\", which are two names of one";
        let fault = Diagnostic::error(codes::robot_file::URDF, message).at(description.span());
        diagnostics.push(fault.with_help("keep one of them"));
        return None;
    }
    let urdf_path = folder_of(&robot_file.path).join(urdf.get_ref());
    // Permission before existence, so that a message does not reveal which files exist outside the project.
    diagnostics.keep(access.check(&urdf_path).map_err(|fault| fault.at(urdf.span())))?;
    // Here instead of when it is read, so that the message points at the key and quotes the path as written.
    if !urdf_path.exists() {
        let fault = urdf_not_found(key, urdf.get_ref(), folder_of(&robot_file.path), access);
        diagnostics.push(fault.at(urdf.span()));
        return None;
    }
    Some(direct_path(&urdf_path))
}

fn declared_packages(
    written: &WrittenRobot,
    folder: &Path,
    access: &FileAccess,
    diagnostics: &mut Diagnostics,
) -> BTreeMap<String, PathBuf> {
    let mut resolve = |(name, written): (&String, &Spanned<PathBuf>)| {
        let path = folder.join(written.get_ref());
        diagnostics.keep(access.check(&path).map_err(|fault| fault.at(written.span())))?;
        // Canonical, because mesh paths are compared with this folder after symbolic links are resolved.
        let canonical = path.canonicalize().ok().filter(|path| path.is_dir());
        let folder = diagnostics.keep(canonical.ok_or_else(|| {
            let message = format!("package \"{name}\": {} is not a folder", path.display());
            Diagnostic::error(codes::robot_file::PACKAGE, message).at(written.span())
        }))?;
        Some((name.clone(), folder))
    };
    written.packages.iter().filter_map(&mut resolve).collect()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use congruent_input::Severity;

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
        let place = |found: &Diagnostic| (found.source.as_ref().unwrap().path.clone(), found.code.name);
        let file = |name| folder.path().join(name);
        assert_eq!(
            found.iter().map(place).collect::<Vec<_>>(),
            [(file("robot.toml"), "robot_file::unknown_link"), (file("r.urdf"), "urdf::massless")]
        );
    }

    /// `URDF` with an inertial for link b, whose largest moment exceeds the sum of the others by 1.
    fn impossible() -> String {
        URDF.replace(
            "<link name='b'/>",
            "\n<link name='b'><inertial><mass value='2'/>\
             <inertia ixx='3' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>",
        )
    }

    #[test]
    fn the_robot_file_repairs_an_inertia() {
        let bare = folder(&[("r.urdf", &impossible())]);
        let description = load_robot(&bare.path().join("r.urdf")).unwrap();
        let refused = description.check_capability(Capability::Physics).unwrap_err();
        assert_eq!((refused[0].code.name, refused[0].severity), ("urdf::inertia", Severity::Error));
        assert!(refused[0].help.as_ref().unwrap().contains("[inertia]\nb = \"repair\""), "{refused:#?}");
        assert_eq!(refused[0].line_column().map(|(line, _)| line), Some(2));
        assert_eq!(description.check_capability(Capability::Clearance), Ok(()));

        let robot_file = "urdf = 'r.urdf'\n[inertia]\nb = 'repair'";
        let repaired = folder(&[("robot.toml", robot_file), ("r.urdf", &impossible())]);
        let description = load_robot(repaired.path()).unwrap();
        assert_eq!(description.check_capability(Capability::Physics), Ok(()));
        let [warning] = &description.warnings[..] else { panic!("{:#?}", description.warnings) };
        assert_eq!(warning.line_column(), Some((3, 5)));
        assert_eq!(
            warning.message,
            "link \"b\": inertia repaired: principal moments 1 kg m2, 1 kg m2, 3 kg m2 in the URDF, 1.33 kg m2, \
             1.33 kg m2, 2.67 kg m2 after the repair (0.577 kg m2 apart in the Frobenius norm)"
        );
        let inertia = description.robot.links()[1].inertia.unwrap();
        assert!(inertia.mass_kg > 1.9 && inertia.tensor_kg_m2[(0, 0)] < 2.7, "{inertia:?}");
    }

    #[test]
    fn a_repair_that_cannot_be_is_refused() {
        let light = impossible().replace("'2'", "'-2'");
        for (line, urdf, message) in [
            ("c = 'repair'", impossible(), "[inertia] c: the robot has no such link"),
            ("a = 'repair'", impossible(), "the link has no <inertial>"),
            ("b = 'repair'", light, "its mass of -2 kg is not positive"),
            ("b = 'mend'", impossible(), "unknown value \"mend\""),
        ] {
            let robot_file = format!("urdf = 'r.urdf'\n[inertia]\n{line}");
            let folder = folder(&[("robot.toml", &robot_file), ("r.urdf", &urdf)]);
            let found = load_robot(folder.path()).unwrap_err();
            let fault = found.iter().find(|found| found.severity == Severity::Error).unwrap();
            assert!(fault.message.contains(message), "{found:#?}");
            assert_eq!(fault.line_column().map(|(line, _)| line), Some(3), "{found:#?}");
        }
    }

    #[test]
    fn an_srdf_that_cannot_be_read_stops_clearance() {
        let robot_file = "urdf = 'r.urdf'\nsrdf = 'r.srdf'";
        for srdf in ["<robot", ""] {
            let folder = folder(&[("robot.toml", robot_file), ("r.urdf", URDF), ("r.srdf", srdf)]);
            let description = load_robot(folder.path()).unwrap();
            assert!(
                description.check_capability(Capability::Clearance).is_err(),
                "{:#?}",
                description.warnings
            );
            assert_eq!(description.check_capability(Capability::Physics), Ok(()));
        }
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
        let codes: Vec<&str> = found.iter().map(|found| found.code.name).collect();
        assert_eq!(codes, ["file::not_found", "robot_file::package", "urdf::massless"]);
    }
}
