//! The scenarios of the project, without the plans of sweeps among them.

use std::{fs, path::PathBuf};

use super::corpus::workspace;

/// The scenarios of a folder of the project, sorted.
pub(crate) fn scenario_files(folder: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(workspace().join(folder)).unwrap().flatten();
    let names = entries.map(|entry| entry.file_name().into_string().unwrap());
    let is_scenario = |name: &String| name.ends_with(".toml") && !name.ends_with(".sweep.toml");
    let mut files: Vec<PathBuf> =
        names.filter(is_scenario).map(|name| workspace().join(folder).join(name)).collect();
    files.sort();
    files
}
