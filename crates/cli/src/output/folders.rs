//! The folder that `--out` names, made if there is none, and removed again if nothing is written to it.

use std::{
    fs,
    path::{Path, PathBuf},
};

use congruent::input::Diagnostic;

use super::file::unwritable;
use crate::codes;

/// The folders that were made for the file, the innermost first.
pub(crate) struct Folders(Vec<PathBuf>);

impl Folders {
    /// Makes the folder that `--out` names.
    pub(crate) fn make(path: &Path) -> Result<Self, Diagnostic> {
        if path.exists() && !path.is_dir() {
            let message = format!("--out {} is not a folder", path.display());
            return Err(
                Diagnostic::error(codes::output::REFUSED, message).with_help("give a folder, or a new name")
            );
        }
        // Only folders that do not exist are made, and so only these are removed if the file is refused.
        let missing =
            path.ancestors().take_while(|folder| !folder.as_os_str().is_empty() && !folder.exists());
        let made = Self(missing.map(Path::to_owned).collect());
        fs::create_dir_all(path).map_err(|error| unwritable(path, &error))?;
        Ok(made)
    }

    /// Removes them; one that is not empty stays.
    pub(crate) fn remove(&self) {
        for folder in &self.0 {
            let _ = fs::remove_dir(folder);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_that_were_made_are_removed_and_no_others() {
        let there = tempfile::tempdir().unwrap();
        let inner = there.path().join("a/b");
        Folders::make(&inner).unwrap().remove();
        assert!(there.path().exists() && !there.path().join("a").exists());
        let made = Folders::make(&inner).unwrap();
        fs::write(there.path().join("a/file"), "").unwrap();
        made.remove();
        assert!(there.path().join("a/file").exists() && !inner.exists());
        Folders::make(there.path()).unwrap().remove();
        assert!(there.path().exists());
    }
}
