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
    let mut files: Vec<PathBuf> =
        entries.map(|entry| entry.path()).filter(|path| is_scenario(path)).collect();
    files.sort();
    files
}

/// A plan is called `<name>.sweep.toml`.
fn is_scenario(path: &Path) -> bool {
    let is_plan =
        path.file_stem().is_some_and(|stem| Path::new(stem).extension() == Some(OsStr::new("sweep")));
    path.extension() == Some(OsStr::new("toml")) && !is_plan
}
