//! The files that a scenario names.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use congruent_input::{Diagnostic, FileAccess, SourceFile};

/// The folder to which the paths in a scenario are relative, and which files may be opened from there.
#[derive(Debug, Clone, Copy)]
pub struct ScenarioFolder<'a> {
    /// The folder.
    pub path: &'a Path,
    /// The files that may be opened.
    pub access: &'a FileAccess,
}

impl ScenarioFolder<'_> {
    /// The text of a file of at most `most_bytes`.
    ///
    /// # Errors
    /// The file cannot be read, may not be opened, or is longer.
    pub fn read_text(&self, name: &str, most_bytes: u64) -> Result<Arc<SourceFile>, Diagnostic> {
        self.access.read_text(&self.path.join(name), most_bytes)
    }

    /// The absolute path of a file.
    pub fn whole(&self, name: &str) -> PathBuf {
        let path = self.path.join(name);
        path.canonicalize().unwrap_or(path)
    }
}
