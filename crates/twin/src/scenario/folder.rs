//! The files that a scenario names.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use congruent_description::{Diagnostic, FileAccess, Mesh, SourceFile, read_mesh};
use nalgebra::Vector3;

/// The folder to which the paths in a scenario are relative, and which files may be opened from there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ScenarioFolder<'a> {
    pub(crate) path: &'a Path,
    pub(crate) access: &'a FileAccess,
}

impl ScenarioFolder<'_> {
    /// The text of a file of at most `most_bytes`.
    pub(crate) fn read_text(&self, name: &str, most_bytes: u64) -> Result<Arc<SourceFile>, Diagnostic> {
        self.access.read_text(&self.path.join(name), most_bytes)
    }

    /// A mesh, scaled.
    pub(crate) fn read_mesh(&self, name: &str, scale: Vector3<f64>) -> Result<Arc<Mesh>, Diagnostic> {
        read_mesh(self.path, name, scale, self.access)
    }

    /// The absolute path of a file.
    pub(crate) fn whole(&self, name: &str) -> PathBuf {
        let path = self.path.join(name);
        path.canonicalize().unwrap_or(path)
    }
}
