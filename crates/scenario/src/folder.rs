//! The files that a scenario names.

use std::path::{Path, PathBuf};

use congruent_input::FileAccess;

/// The folder to which the paths in a scenario are relative, and which files may be opened from there.
#[derive(Debug, Clone, Copy)]
pub struct ScenarioFolder<'a> {
    /// The folder of the scenario file; an empty path is the current folder.
    pub path: &'a Path,
    /// The files that may be opened.
    pub access: &'a FileAccess,
}

impl ScenarioFolder<'_> {
    /// The absolute path of a file.
    pub fn whole(&self, name: &str) -> PathBuf {
        let path = self.path.join(name);
        path.canonicalize().unwrap_or(path)
    }
}
