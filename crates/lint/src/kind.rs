//! Decides by its content of which kind a file is: `.xml` may be a URDF, an MJCF or an SRDF, `.toml` a robot file or a scenario.

use std::{path::Path, sync::Arc};

use congruent_description::{RobotDescription, URDF_BYTES, file_of_robot, is_mjcf, open};
use congruent_input::{Diagnostic, FileAccess, SourceFile, TomlKind, head_of, xml};
use schemars::JsonSchema;
use serde::Serialize;

use crate::codes;

/// A kind of file that can be linted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FileKind {
    /// A robot description in URDF.
    Urdf,
    /// A robot description in MJCF, the XML of MuJoCo; rules about the text of a URDF do not apply.
    Mjcf,
    /// A robot file with what it names, or a folder with one.
    RobotFile,
    /// A semantic robot description (SRDF): groups, named states, disabled collision pairs.
    Srdf,
    /// A scenario with its robot.
    Scenario,
    /// A table of joint configurations, as `fk` reads it.
    Configurations,
    /// A table of tool poses that are targets of inverse kinematics, as `ik` reads it.
    Targets,
    /// A table of measured poses or points, as `calibrate` reads it.
    Measurements,
}

/// A file that `lint` examines, with its kind.
#[derive(Debug)]
pub struct FileToLint {
    /// The kind of the file. XML without a sign of another kind is taken as a URDF, whose reader then reports what is wrong.
    pub kind: FileKind,
    /// The text of the file; `None` for tables, which are not kept in memory as a whole.
    pub source: Option<Arc<SourceFile>>,
}

/// Elements at the top of an SRDF.
const SRDF_ELEMENTS: [&str; 6] =
    ["disable_collisions", "group", "group_state", "end_effector", "virtual_joint", "passive_joint"];
/// Bytes of a table by which its kind is decided. Kind: choice; several rows of any robot.
const HEAD_BYTES: usize = 16 << 10;
/// The time column, which only tables of motions and of torques have.
const TIME: &str = "time_s";

/// Files that `lint` refuses by their extension: extension, what the file is, and what to do instead.
const ELSEWHERE: [(&str, &str, &str); 6] = [
    ("mcap", "a log", "`congruent describe` surveys it"),
    ("bag", "a log of ROS, which no command reads", "write its joint states as CSV or JSON"),
    ("rrd", "a recording", "`congruent inspect` checks it"),
    ("parquet", "a trajectory", "`congruent compare` reads it"),
    ("stl", "a mesh", "lint the URDF that names it"),
    ("sdf", "a model for a simulator", "write it as a URDF"),
];

impl FileToLint {
    /// Opens a file that a person names, and decides its kind by its content.
    ///
    /// # Errors
    /// The file cannot be read, or its content is of no kind that can be linted.
    pub fn open(path: &Path, access: &FileAccess) -> Result<Self, Diagnostic> {
        let file = file_of_robot(path)?;
        let extension = file.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        // By the extension, before the file is opened: logs may have gigabytes.
        if let Some((_, what, now)) = ELSEWHERE.iter().find(|(end, ..)| *end == extension) {
            let message = format!("lint cannot read {}: it is {what}", path.display());
            return Err(Diagnostic::error(codes::lint::KIND, message).with_help(*now));
        }
        if ["json", "jsonl", "csv"].contains(&extension.as_str()) && file.is_file() {
            // Tables may be large; their first keys decide.
            let head = head_of(&file, HEAD_BYTES)?;
            return table(path, &head).map(|kind| Self { kind, source: None });
        }
        let source = open(&file, access, URDF_BYTES)?;
        let begin = source.text.trim_start_matches(['\u{feff}', ' ', '\t', '\r', '\n']);
        let kind = match extension.as_str() {
            "srdf" => FileKind::Srdf,
            _ if is_mjcf(&source.text) => FileKind::Mjcf,
            "urdf" | "xacro" => FileKind::Urdf,
            "toml" if path.is_dir() => FileKind::RobotFile,
            "toml" => match TomlKind::from_text(&source.text) {
                Some(TomlKind::Scenario) => FileKind::Scenario,
                Some(TomlKind::RobotFile) | None => FileKind::RobotFile,
            },
            _ if begin.starts_with('<') || begin.is_empty() => FileKind::from_xml_text(&source.text),
            _ => return Err(no_kind(path, "the text is not XML")),
        };
        Ok(Self { kind, source: Some(source) })
    }
}

fn no_kind(path: &Path, why: &str) -> Diagnostic {
    let message = format!(
        "{} is not a URDF, MJCF, SRDF, robot file, scenario or table of configurations: {why}",
        path.display()
    );
    Diagnostic::error(codes::lint::KIND, message).with_help(
        "give a .urdf, an .xml with <mujoco>, a .srdf or .toml, a folder with robot.toml, or a .json, .jsonl or .csv that `fk`, `ik` or `calibrate` reads",
    )
}

/// The kind of a table, by the keys or columns of its first rows.
fn table(path: &Path, head: &str) -> Result<FileKind, Diagnostic> {
    let has = |keys: &[&str]| keys.iter().any(|key| head.contains(&format!("\"{key}")));
    let header =
        head.lines().find(|line| !line.trim().is_empty() && !line.starts_with('#')).unwrap_or_default();
    match head.trim_start_matches('\u{feff}').trim_start().chars().next() {
        None => Err(no_kind(path, "it is empty")),
        Some('{') if is_configuration(header) => Ok(FileKind::Configurations),
        Some('{') => Err(no_kind(path, "it is a JSON object that is no configuration")),
        // Keys of poses distinguish the three kinds: configurations have none, measurements have joint positions as
        // well.
        Some('[') if !has(&["translation_", "quaternion_", "rpy_"]) => Ok(FileKind::Configurations),
        Some('[') if has(&["q\""]) => Ok(FileKind::Measurements),
        Some('[') => Ok(FileKind::Targets),
        Some(_) if header.split(',').any(|cell| cell.trim() == TIME) => {
            let message =
                format!("{} is a table over time, which is checked with its scenario", path.display());
            Err(Diagnostic::error(codes::lint::KIND, message)
                .with_help("lint the scenario that names this file"))
        }
        Some(_) => Ok(FileKind::Measurements),
    }
}

/// Whether a line of JSON begins as a configuration, so that the text is one configuration per line.
fn is_configuration(line: &str) -> bool {
    let dense: String = line.chars().filter(|c| !c.is_whitespace() && *c != '\u{feff}').collect();
    ["{\"q\":{", "{\"v\":{", "{\"tau\":{", "{\"a\":{", "{}"].iter().any(|begin| dense.starts_with(begin))
}

impl FileKind {
    /// The kind of the file that has the links and joints of a robot: a URDF, an MJCF, or the robot file of a table or of screws
    /// without one.
    pub fn of_links(description: &RobotDescription) -> Self {
        // In other variables or frames a robot has no places, and its file is still a URDF.
        let is_urdf = description.places.urdf.is_some()
            || description.urdf_path.extension().is_some_and(|extension| extension == "urdf");
        match description.own_model() {
            Some(_) => Self::RobotFile,
            None if is_urdf => Self::Urdf,
            None => Self::Mjcf,
        }
    }

    fn from_xml_text(text: &str) -> Self {
        // What is no XML gets the messages of a URDF.
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
            FileToLint::open(&path, &FileAccess::default())
                .map(|file| file.kind)
                .map_err(|fault| fault.code.name)
        };
        assert_eq!(kind("a.toml", "urdf = 'a.urdf'\n[[dh.row]]\n"), Ok(FileKind::RobotFile));
        assert_eq!(kind("b.toml", "schema_version = 1\nrobot = '..'\n[[motion]]"), Ok(FileKind::Scenario));
        assert_eq!(kind("c.toml", "schema_version = 1\nrobot = \"..\n[["), Ok(FileKind::Scenario));
        assert_eq!(kind("d.xml", "<robot name='r'><link name='a'/></robot>"), Ok(FileKind::Urdf));
        assert_eq!(kind("e.xml", "<robot name='r'><group name='arm'/></robot>"), Ok(FileKind::Srdf));
        assert_eq!(kind("f.xml", "<robot"), Ok(FileKind::Urdf));
        assert_eq!(kind("i.xml", "<!-- arm -->\n<mujoco model='m'>"), Ok(FileKind::Mjcf));
        assert_eq!(kind("g.txt", "a,b\n1,2\n"), Err("lint::kind"));
        assert_eq!(kind("h.mcap", "\u{89}MCAP0"), Err("lint::kind"));
        let folder = FileToLint::open(folder.path(), &FileAccess::default());
        assert_eq!(folder.unwrap_err().code.name, "load::no_robot_file");
    }

    #[test]
    fn a_table_is_what_its_first_rows_are() {
        let kind = |head: &str| table(Path::new("t"), head).map_err(|fault| fault.code.name);
        assert_eq!(kind("[{\"q\": {\"a\": 1}}]"), Ok(FileKind::Configurations));
        assert_eq!(kind("{\"q\": {\"a\": 1}}\n{}\n"), Ok(FileKind::Configurations));
        assert_eq!(kind("[{\"translation_m\": [0, 0, 1]}]"), Ok(FileKind::Targets));
        assert_eq!(kind("[{\"q\": {}, \"translation_mm\": [0, 0, 1]}]"), Ok(FileKind::Measurements));
        assert_eq!(kind("# made by hand\nj1_deg,x_m\n1,2\n"), Ok(FileKind::Measurements));
        for no_table in ["time_s,j1_rad\n0,0\n", "{\"verdict\": \"pass\"}", ""] {
            assert_eq!(kind(no_table), Err("lint::kind"));
        }
    }
}
