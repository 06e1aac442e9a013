//! From a path to a [`RobotDescription`]: the one place that decides which files are opened.

use std::path::Path;

use crate::{RobotDescription, diagnostic::Diagnostic};

/// Loads a robot: a folder with `robot.toml`, that file under any name, or a bare `.urdf`.
///
/// # Errors
/// Every finding, errors and warnings, when at least one is an error.
pub fn load_robot(path: &Path) -> Result<RobotDescription, Vec<Diagnostic>> {
    Err(vec![Diagnostic::error("load::todo", path.display().to_string())])
}
