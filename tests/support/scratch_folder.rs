//! A temporary folder in which a test writes its files.

use std::{fs, path::Path};

use tempfile::TempDir;

use super::{command::text, corpus::workspace};

/// A folder that is removed with its files at the end of the test.
pub(crate) struct ScratchFolder(TempDir);

impl ScratchFolder {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub(crate) fn path(&self) -> &Path {
        self.0.path()
    }

    pub(crate) fn write(&self, name: &str, contents: &str) -> String {
        let path = self.0.path().join(name);
        fs::write(&path, contents).unwrap();
        text(&path)
    }

    /// A copy of a robot with pieces of its robot file replaced.
    #[track_caller]
    pub(crate) fn robot(&self, name: &str, changes: &[(&str, &str)]) -> String {
        let folder = self.0.path().join(name);
        fs::create_dir(&folder).unwrap();
        for entry in fs::read_dir(workspace().join("robots").join(name)).unwrap().flatten() {
            if entry.path().is_file() {
                fs::copy(entry.path(), folder.join(entry.file_name())).unwrap();
            }
        }
        let file = folder.join("robot.toml");
        let mut toml = fs::read_to_string(&file).unwrap();
        for (from, to) in changes {
            assert!(toml.contains(from), "{from:?} is not in\n{toml}");
            toml = toml.replacen(from, to, 1);
        }
        fs::write(&file, toml).unwrap();
        text(&folder)
    }
}

/// Names of what is in a folder, sorted.
pub(crate) fn file_names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap().flatten();
    let mut names: Vec<String> = entries.map(|entry| entry.file_name().into_string().unwrap()).collect();
    names.sort();
    names
}
