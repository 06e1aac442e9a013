//! Which kind of file a path is, by its content: `.xml` is a URDF as well as an SRDF, `.toml` a robot file as well as a
//! scenario.

use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;

use crate::{
    diagnostic::Diagnostic,
    files::{FileAccess, is_standard_input},
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
}

/// Keys at the top of a robot file, and of a scenario.
const ROBOT_KEYS: [&str; 7] = ["urdf", "dh", "tcp", "inertia", "inertial", "packages", "tolerance"];
const SCENARIO_KEYS: [&str; 7] =
    ["schema_version", "simulation", "motion", "controller", "check", "robot", "start"];
/// Elements at the top of an SRDF.
const SRDF_ELEMENTS: [&str; 6] =
    ["disable_collisions", "group", "group_state", "end_effector", "virtual_joint", "passive_joint"];

impl FileKind {
    /// The kind of a path. A URDF if nothing speaks for another: its reader says what is wrong.
    ///
    /// # Errors
    /// The content is that of no such file, or cannot be read.
    pub fn of(path: &Path, access: &FileAccess) -> Result<Self, Diagnostic> {
        if path.is_dir() {
            return Ok(Self::RobotFile);
        }
        let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        match extension.as_str() {
            "urdf" | "xacro" => return Ok(Self::Urdf),
            "srdf" => return Ok(Self::Srdf),
            // What comes from a pipe can be read once.
            _ if is_standard_input(path) || !path.is_file() => return Ok(Self::Urdf),
            _ => {}
        }
        let text = &access.fresh().read_named_text(path, URDF_BYTES)?.text;
        if extension == "toml" {
            return Ok(Self::of_toml(text));
        }
        if text.trim_start_matches(['\u{feff}', ' ', '\t', '\r', '\n']).starts_with('<') {
            return Ok(Self::of_xml(text));
        }
        let message = format!("{} is no URDF, SRDF, robot file or scenario", path.display());
        Err(Diagnostic::error("lint::kind", message).with_help(
            "give a .urdf, .srdf or .toml, or a folder with robot.toml; tables of configurations and measurements are \
             checked by the commands that read them",
        ))
    }

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
            FileKind::of(&path, &FileAccess::default()).map_err(|fault| fault.code)
        };
        assert_eq!(kind("a.toml", "urdf = 'a.urdf'\n[[dh.row]]\n"), Ok(FileKind::RobotFile));
        assert_eq!(kind("b.toml", "schema_version = 1\nrobot = '..'\n[[motion]]"), Ok(FileKind::Scenario));
        assert_eq!(kind("c.toml", "schema_version = 1\nrobot = \"..\n[["), Ok(FileKind::Scenario));
        assert_eq!(kind("d.xml", "<robot name='r'><link name='a'/></robot>"), Ok(FileKind::Urdf));
        assert_eq!(kind("e.xml", "<robot name='r'><group name='arm'/></robot>"), Ok(FileKind::Srdf));
        assert_eq!(kind("f.xml", "<robot"), Ok(FileKind::Urdf));
        assert_eq!(kind("g.csv", "a,b\n1,2\n"), Err("lint::kind"));
        let folder = FileKind::of(folder.path(), &FileAccess::default());
        assert_eq!(folder.unwrap(), FileKind::RobotFile);
    }
}
