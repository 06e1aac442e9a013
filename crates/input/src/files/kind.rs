//! What is expected of a text that another file names, outside of its project: anything else could be a secret, of which the
//! messages of a reader would show words.

use std::{cmp::Ordering, sync::Arc};

use crate::{
    codes,
    diagnostic::{Diagnostic, SourceFile},
};

/// A kind of text that a file may name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TextKind {
    /// A URDF, an SRDF or an MJCF: XML with the element `robot` or `mujoco`.
    Robot,
    /// A robot file: TOML with the key `urdf` or `description`, or a table `dh` or `poe`.
    RobotFile,
    /// A table: a line of names, then numbers.
    Table,
}

impl TextKind {
    /// The text, unless it is from outside of the project and not of this kind.
    ///
    /// # Errors
    /// It is not of this kind; nothing of it is quoted.
    pub fn check(self, source: Arc<SourceFile>) -> Result<Arc<SourceFile>, Diagnostic> {
        if !source.is_foreign || self.is_met_by(&source.text) {
            return Ok(source);
        }
        let message = format!("{} is not {}", source.path.display(), self.words());
        let help = "it is outside of the project, so nothing of it is shown; --allow DIR counts its folder as the project";
        Err(Diagnostic::error(codes::file::KIND, message).with_help(help))
    }

    fn words(self) -> &'static str {
        match self {
            Self::Robot => "a URDF, an SRDF or an MJCF",
            Self::RobotFile => "a robot file",
            Self::Table => "a table of numbers",
        }
    }

    fn is_met_by(self, text: &str) -> bool {
        let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
        match self {
            Self::Robot => {
                text.trim_start().starts_with('<') && (text.contains("<robot") || text.contains("<mujoco"))
            }
            Self::RobotFile => lines.any(|line| {
                let has_value = |rest: &str| rest.trim_start().starts_with('=');
                let names_model =
                    ["urdf", "description"].iter().any(|key| line.strip_prefix(key).is_some_and(has_value));
                names_model || line.starts_with("[dh") || line.starts_with("[poe")
            }),
            Self::Table => lines.nth(1).is_some_and(|line| line.split([',', ';', '\t']).all(is_number)),
        }
    }
}

/// Which of the two files in TOML a text is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TomlKind {
    /// A robot file.
    RobotFile,
    /// A scenario.
    Scenario,
}

/// Keys at the top of a robot file, and of a scenario.
const ROBOT_KEYS: [&str; 8] = ["urdf", "dh", "poe", "tcp", "inertia", "inertial", "packages", "tolerance"];
const SCENARIO_KEYS: [&str; 7] =
    ["schema_version", "simulation", "motion", "controller", "check", "robot", "start"];

impl TomlKind {
    /// By the keys at the top of the text; `None` if it has as many of the one as of the other. Lines are searched instead of
    /// parsed, so that the kind of a file with a syntax error is found, too.
    pub fn from_text(text: &str) -> Option<Self> {
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
        match count(&SCENARIO_KEYS).cmp(&count(&ROBOT_KEYS)) {
            Ordering::Greater => Some(Self::Scenario),
            Ordering::Less => Some(Self::RobotFile),
            Ordering::Equal => None,
        }
    }
}

fn is_number(cell: &str) -> bool {
    let cell = cell.trim().trim_matches('"');
    cell.is_empty() || cell.parse::<f64>().is_ok()
}
