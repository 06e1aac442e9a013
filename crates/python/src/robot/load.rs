//! Where robots come from: a file or a folder, a text, a xacro file.

use std::{path::Path, sync::Arc};

use congruent::{
    codes,
    description::{RobotDescription, load_opened_robot, load_robot_with},
    input::{Diagnostic, FileAccess, Findings, RosPackages, SourceFile},
};
use pyo3::{
    exceptions::{PyImportError, PyKeyboardInterrupt},
    prelude::*,
    types::PyDict,
};

use crate::error::refused;

/// What messages call a text that came without a file.
const NO_FILE: &str = "<text>";

/// The files that a robot may name, as the command finds them: packages of ROS by its environment.
pub(crate) fn access() -> Result<FileAccess, Findings> {
    Ok(FileAccess::new(RosPackages::from_environment(), &[])?)
}

/// The robot of a path.
pub(crate) fn from_path(path: &Path) -> Result<RobotDescription, Findings> {
    load_robot_with(path, &access()?)
}

/// The robot of a URDF or an MJCF without a file; relative paths in it are those of the current folder.
pub(super) fn from_text(text: &str) -> Result<RobotDescription, Findings> {
    named_text(text, Path::new(NO_FILE))
}

fn named_text(text: &str, path: &Path) -> Result<RobotDescription, Findings> {
    let source = SourceFile { path: path.to_owned(), text: text.to_owned(), is_foreign: false };
    load_opened_robot(&Arc::new(source), &access()?)
}

/// The robot of a xacro file, expanded by the Python package xacro.
pub(super) fn from_xacro(
    py: Python<'_>,
    path: &Path,
    arguments: Option<&Bound<'_, PyDict>>,
) -> PyResult<RobotDescription> {
    let file = path.display();
    let xacro = py.import("xacro").map_err(|error| {
        if !error.is_instance_of::<PyImportError>(py) {
            return error;
        }
        let message = format!("{file} cannot be expanded: the Python package xacro is not installed");
        refused(py, Diagnostic::error(codes::python::XACRO, message).with_help("pip install xacro"))
    })?;
    let mappings = PyDict::new(py);
    for (name, value) in arguments.into_iter().flatten() {
        // Arguments of xacro are texts: `true` and not `True`.
        let text = value.str()?.to_string();
        let text = if value.is_instance_of::<pyo3::types::PyBool>() { text.to_lowercase() } else { text };
        mappings.set_item(name, text)?;
    }
    let options = PyDict::new(py);
    options.set_item("mappings", mappings)?;
    let expanded = xacro
        .call_method("process_file", (path.as_os_str(),), Some(&options))
        .and_then(|document| document.call_method0("toxml")?.extract::<String>())
        .map_err(|error| {
            if error.is_instance_of::<PyKeyboardInterrupt>(py) {
                return error;
            }
            let kind = error.get_type(py).name().map_or_else(|_| String::new(), |name| name.to_string());
            let message = format!("{file} cannot be expanded: {kind}: {}", error.value(py));
            let help = "correct the file, or give its arguments: Robot.from_xacro(path, name=\"ur5e\")";
            refused(py, Diagnostic::error(codes::python::XACRO, message).with_help(help))
        })?;
    py.detach(|| named_text(&expanded, path)).map_err(|findings| refused(py, findings))
}
