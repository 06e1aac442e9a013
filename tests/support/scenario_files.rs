//! The scenarios of the project, without the plans of sweeps among them.

use std::{
    ffi::OsStr,
    fs,
    path::{Path, PathBuf},
};

use super::corpus::workspace;

/// The scenarios of a folder of the project, sorted.
pub(crate) fn scenario_files(folder: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(workspace().join(folder)).unwrap().flatten();
    let is_scenario = |path: &PathBuf| path.extension() == Some(OsStr::new("toml")) && !is_plan(path);
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.path()).filter(is_scenario).collect();
    files.sort();
    files
}

/// Whether a file is the plan of a sweep: `<name>.sweep.toml`.
pub(crate) fn is_plan(path: &Path) -> bool {
    path.to_string_lossy().ends_with(".sweep.toml")
}
