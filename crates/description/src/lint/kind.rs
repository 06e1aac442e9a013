//! Which kind of file a path is, by its content: `.xml` is a URDF as well as an SRDF, `.toml` a robot file as well as a
//! scenario.

use std::{path::Path, sync::Arc};

use schemars::JsonSchema;
use serde::Serialize;

use crate::{
    diagnostic::{Diagnostic, SourceFile},
    files::{FileAccess, head_of},
    load::{file_of_robot, open},
    urdf::URDF_BYTES,
    xml,
};

/// A kind of file that can be linted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FileKind {
    /// A URDF.
    Urdf,
    /// A robot file with what it names, or a folder with one.
    RobotFile,
    /// An SRDF.
    Srdf,
    /// A scenario with its robot.
    Scenario,
    /// Configurations of joints.
    Configurations,
    /// Poses that are targets of inverse kinematics.
    Targets,
    /// Measurements of poses or points.
    Measurements,
}

/// A file with its kind.
#[derive(Debug)]
pub struct FileToLint {
    /// What it is. A URDF if nothing speaks for another: its reader says what is wrong.
    pub kind: FileKind,
    /// Its text; `None` of tables, which are not held as a whole.
    pub source: Option<Arc<SourceFile>>,
}

/// Keys at the top of a robot file, and of a scenario.
const ROBOT_KEYS: [&str; 7] = ["urdf", "dh", "tcp", "inertia", "inertial", "packages", "tolerance"];
const SCENARIO_KEYS: [&str; 7] =
    ["schema_version", "simulation", "motion", "controller", "check", "robot", "start"];
/// Elements at the top of an SRDF.
const SRDF_ELEMENTS: [&str; 6] =
    ["disable_collisions", "group", "group_state", "end_effector", "virtual_joint", "passive_joint"];
/// How much of a table is looked at. Kind: choice; several rows of any robot.
const HEAD_BYTES: usize = 16 << 10;
/// The column of times, which tables of motions and of torques have.
const TIME: &str = "time_s";

/// What else has a reader, by the end of its name: what it is, and what checks it.
const ELSEWHERE: [(&str, &str, &str); 6] = [
    ("mcap", "an MCAP log, which no command reads", "write its joint states as CSV or JSON"),
    ("bag", "a log of ROS, which no command reads", "write its joint states as CSV or JSON"),
    ("rrd", "a recording", "`congruent inspect` checks it"),
    ("parquet", "a trajectory", "`congruent compare` reads it"),
    ("stl", "a mesh", "lint the URDF that names it"),
    ("sdf", "a model for a simulator", "write it as a URDF"),
];

impl FileToLint {
    /// Opens what a person names, and finds out by its content what it is.
    ///
    /// # Errors
    /// The content is that of no file that can be linted, or cannot be read.
    pub fn open(path: &Path, access: &FileAccess) -> Result<Self, Diagnostic> {
        let file = file_of_robot(path)?;
        let extension = file.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        if let Some((_, what, now)) = ELSEWHERE.iter().find(|(end, ..)| *end == extension) {
            let message = format!("{} is {what}, not a file that can be linted", path.display());
            return Err(Diagnostic::error("lint::kind", message).with_help(*now));
        }
        if ["json", "csv"].contains(&extension.as_str()) && file.is_file() {
            let head = head_of(&file, HEAD_BYTES)?;
            return table(path, &head).map(|kind| Self { kind, source: None });
        }
        let source = open(&file, access, URDF_BYTES)?;
        let begin = source.text.trim_start_matches(['\u{feff}', ' ', '\t', '\r', '\n']);
        let kind = match extension.as_str() {
            "srdf" => FileKind::Srdf,
            "urdf" | "xacro" => FileKind::Urdf,
            "toml" if path.is_dir() => FileKind::RobotFile,
            "toml" => FileKind::of_toml(&source.text),
            _ if begin.starts_with('<') || begin.is_empty() => FileKind::of_xml(&source.text),
            _ => return Err(no_kind(path, "the text is no XML")),
        };
        Ok(Self { kind, source: Some(source) })
    }
}

fn no_kind(path: &Path, why: &str) -> Diagnostic {
    let message = format!(
        "{} is no URDF, SRDF, robot file, scenario or table of configurations: {why}",
        path.display()
    );
    Diagnostic::error("lint::kind", message).with_help(
        "give a .urdf, .srdf or .toml, a folder with robot.toml, or a .json or .csv that `fk`, `ik` or `calibrate` reads",
    )
}

/// The kind of a table, by its first rows.
fn table(path: &Path, head: &str) -> Result<FileKind, Diagnostic> {
    let has = |keys: &[&str]| keys.iter().any(|key| head.contains(&format!("\"{key}")));
    let header =
        head.lines().find(|line| !line.trim().is_empty() && !line.starts_with('#')).unwrap_or_default();
    match head.trim_start_matches('\u{feff}').trim_start().chars().next() {
        None => Err(no_kind(path, "it is empty")),
        Some('{') => Err(no_kind(path, "it is one JSON object, and tables are arrays")),
        Some('[') if !has(&["translation_", "quaternion_", "rpy_"]) => Ok(FileKind::Configurations),
        Some('[') if has(&["q\""]) => Ok(FileKind::Measurements),
        Some('[') => Ok(FileKind::Targets),
        Some(_) if header.split(',').any(|cell| cell.trim() == TIME) => {
            let message =
                format!("{} is a table over time, whose meaning a scenario gives it", path.display());
            Err(Diagnostic::error("lint::kind", message)
                .with_help("lint the scenario that names it, which reads it as `run` does"))
        }
        Some(_) => Ok(FileKind::Measurements),
    }
}

impl FileKind {
    /// By the keys at the top, of which some stand even in a text that is no TOML.
    fn of_toml(text: &str) -> Self {
        let count = |keys: &[&str]| {
            let is_key = |line: &str| {
                let word: String = line
                    .trim_start_matches('[')
                    .chars()
                    .take_while(|c| c.is_ascii_alphanumeric() || *c == '_')
                    .collect();
                keys.contains(&word.as_str())
            };
            text.lines().filter(|line| is_key(line.trim_start())).count()
        };
        if count(&SCENARIO_KEYS) > count(&ROBOT_KEYS) { Self::Scenario } else { Self::RobotFile }
    }

    fn of_xml(text: &str) -> Self {
        let Ok(document) = xml::parse(text) else { return Self::Urdf };
        let top = |names: &[&str]| {
            let mut children = document.root_element().children();
            children.any(|node| node.is_element() && names.contains(&node.tag_name().name()))
        };
        if top(&SRDF_ELEMENTS) && !top(&["link", "joint"]) { Self::Srdf } else { Self::Urdf }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_content_decides() {
        let folder = tempfile::tempdir().unwrap();
        let kind = |name: &str, text: &str| {
            let path = folder.path().join(name);
            std::fs::write(&path, text).unwrap();
            FileToLint::open(&path, &FileAccess::default()).map(|file| file.kind).map_err(|fault| fault.code)
        };
        assert_eq!(kind("a.toml", "urdf = 'a.urdf'\n[[dh.row]]\n"), Ok(FileKind::RobotFile));
        assert_eq!(kind("b.toml", "schema_version = 1\nrobot = '..'\n[[motion]]"), Ok(FileKind::Scenario));
        assert_eq!(kind("c.toml", "schema_version = 1\nrobot = \"..\n[["), Ok(FileKind::Scenario));
        assert_eq!(kind("d.xml", "<robot name='r'><link name='a'/></robot>"), Ok(FileKind::Urdf));
        assert_eq!(kind("e.xml", "<robot name='r'><group name='arm'/></robot>"), Ok(FileKind::Srdf));
        assert_eq!(kind("f.xml", "<robot"), Ok(FileKind::Urdf));
        assert_eq!(kind("g.txt", "a,b\n1,2\n"), Err("lint::kind"));
        assert_eq!(kind("h.mcap", "\u{89}MCAP0"), Err("lint::kind"));
        let folder = FileToLint::open(folder.path(), &FileAccess::default());
        assert_eq!(folder.unwrap_err().code, "load::no_robot_file");
    }

    #[test]
    fn a_table_is_what_its_first_rows_are() {
        let kind = |head: &str| table(Path::new("t"), head).map_err(|fault| fault.code);
        assert_eq!(kind("[{\"q\": {\"a\": 1}}]"), Ok(FileKind::Configurations));
        assert_eq!(kind("[{\"translation_m\": [0, 0, 1]}]"), Ok(FileKind::Targets));
        assert_eq!(kind("[{\"q\": {}, \"translation_mm\": [0, 0, 1]}]"), Ok(FileKind::Measurements));
        assert_eq!(kind("# made by hand\nj1_deg,x_m\n1,2\n"), Ok(FileKind::Measurements));
        for no_table in ["time_s,j1_rad\n0,0\n", "{\"verdict\": \"pass\"}", ""] {
            assert_eq!(kind(no_table), Err("lint::kind"));
        }
    }
}
