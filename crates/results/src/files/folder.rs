//! The folder of a scenario's results.

use std::{
    fs, io,
    path::{Path, PathBuf},
};

use congruent_input::InputFile;

use super::{
    lock::{FolderLock, LockError},
    names::{result_files, result_names},
    whole_file::{OutputError, is_same_file, is_temporary_of, write_whole},
};

/// The folder that holds one scenario's results. As long as it is not dropped, no other run writes there.
#[derive(Debug)]
pub struct OutputFolder {
    path: PathBuf,
    _lock: FolderLock,
}

/// Why there is no folder for results.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FolderError {
    /// It cannot be made or written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// Another run writes there.
    #[error("{} is in use: {holder} is writing its results to it", .folder.display())]
    InUse {
        /// The folder that is in use.
        folder: PathBuf,
        /// The process that writes to the folder.
        holder: String,
    },
    /// A file that the run reads would be replaced.
    #[error("the results would overwrite {}, which the scenario reads", .file.display())]
    IsInput {
        /// The input file that would be overwritten.
        file: PathBuf,
    },
}

impl OutputFolder {
    /// Where the results of a scenario of this name go.
    pub fn path_for(out: &Path, scenario: &str) -> PathBuf {
        out.join(file_name(scenario))
    }

    /// Makes the folder, so that only this process writes there, and removes the results of an earlier run; none of these is
    /// a file of `inputs`.
    ///
    /// # Errors
    /// [`FolderError`] if the folder cannot be made or written, is in use, or holds a file that the run reads.
    pub fn create(out: &Path, scenario: &str, inputs: &[InputFile]) -> Result<Self, FolderError> {
        let path = Self::path_for(out, scenario);
        let refused = |source| OutputError { path: path.clone(), source };
        fs::create_dir_all(&path).map_err(refused)?;
        let lock = FolderLock::take(&path, scenario).map_err(|error| match error {
            LockError::Held(holder) => FolderError::InUse { folder: path.clone(), holder },
            LockError::Io(source) => refused(source).into(),
        })?;
        let folder = Self { path, _lock: lock };
        for file in result_files(folder.path()) {
            if inputs.iter().any(|input| is_same_file(&input.path, &file)) {
                return Err(FolderError::IsInput { file });
            }
        }
        result_names().try_for_each(|name| folder.remove(name))?;
        folder.remove_temporaries().map_err(|source| folder.refused("", source))?;
        Ok(folder)
    }

    /// Removes what a process that was killed in between had not yet renamed to a result.
    fn remove_temporaries(&self) -> io::Result<()> {
        for entry in fs::read_dir(&self.path)? {
            let name = entry?.file_name();
            let is_temporary = |name: &str| result_names().any(|of| is_temporary_of(of, name));
            if let Some(name) = name.to_str().filter(|name| is_temporary(name)) {
                fs::remove_file(self.file(name))?;
            }
        }
        Ok(())
    }

    /// Path of the folder of the results.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// A file in it.
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Writes a file whole.
    ///
    /// # Errors
    /// [`OutputError`] where it cannot be written; the name then does not exist.
    pub fn write(&self, name: &str, contents: &[u8]) -> Result<(), OutputError> {
        write_whole(&self.file(name), contents)
    }

    /// Removes a file, unless there is none.
    ///
    /// # Errors
    /// [`OutputError`] if it cannot be removed.
    pub fn remove(&self, name: &str) -> Result<(), OutputError> {
        match fs::remove_file(self.file(name)) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(self.refused(name, error)),
            _ => Ok(()),
        }
    }

    /// Renames a file from its temporary name.
    ///
    /// # Errors
    /// [`OutputError`] if it cannot be renamed.
    pub fn publish(&self, temporary: &str, name: &str) -> Result<(), OutputError> {
        fs::rename(self.file(temporary), self.file(name)).map_err(|source| self.refused(name, source))
    }

    fn refused(&self, name: &str, source: io::Error) -> OutputError {
        OutputError { path: self.file(name), source }
    }
}

/// A scenario's name as a folder name: what is not a letter, a digit, `_`, `-` or `.` becomes `_`.
fn file_name(scenario: &str) -> String {
    const MOST_BYTES: usize = 100;
    let safe = |c: char| if c.is_alphanumeric() || matches!(c, '_' | '-' | '.') { c } else { '_' };
    let mut name: String = scenario.chars().take(MOST_BYTES).map(safe).collect();
    while name.len() > MOST_BYTES {
        name.pop();
    }
    // A name of dots alone would be the folder itself or the one above.
    if name.chars().all(|c| c == '.') { "_".repeat(name.len().max(1)) } else { name }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stay_inside_the_output_folder() {
        let path = |name: &str| OutputFolder::path_for(Path::new("out"), name);
        assert_eq!(path("ur5e_pick"), Path::new("out/ur5e_pick"));
        assert_eq!(path("../../etc"), Path::new("out/.._.._etc"));
        assert_eq!(path(".."), Path::new("out/__"));
        assert_eq!(path(&"\u{65e5}".repeat(300)), Path::new("out").join("\u{65e5}".repeat(33)));
        assert_eq!(path("a]]>\"\n\0b"), Path::new("out/a______b"));
    }

    #[test]
    fn a_folder_that_is_a_file_is_refused() {
        let out = std::env::temp_dir().join(format!("congruent-files-{}", std::process::id()));
        fs::write(&out, "a file").unwrap();
        let error = OutputFolder::create(&out, "name", &[]).unwrap_err();
        fs::remove_file(&out).unwrap();
        assert!(error.to_string().starts_with("cannot write"), "{error}");
    }

    #[test]
    fn one_run_at_a_time_writes_to_a_folder() {
        let out = tempfile::tempdir().unwrap();
        let first = OutputFolder::create(out.path(), "name", &[]).unwrap();
        first.write("report.json", b"{}").unwrap();
        let error = OutputFolder::create(out.path(), "name", &[]).unwrap_err().to_string();
        let process = format!("scenario \"name\" of process {}", std::process::id());
        assert!(error.contains(&process), "{error}");
        assert!(first.file("report.json").exists(), "the second has removed nothing");
        drop(first);
        let left: Vec<_> = fs::read_dir(out.path().join("name")).unwrap().collect();
        assert_eq!(left.len(), 1, "the report alone: {left:?}");
        OutputFolder::create(out.path(), "name", &[]).unwrap();
        assert!(
            !out.path().join("name/report.json").exists(),
            "what was there before is no result of this run"
        );
    }

    #[test]
    fn what_is_read_is_not_replaced() {
        let out = tempfile::tempdir().unwrap();
        let resolved = out.path().join("name/scenario.resolved.toml");
        fs::create_dir(resolved.parent().unwrap()).unwrap();
        fs::write(&resolved, "it").unwrap();
        let inputs = [InputFile { file: String::new(), sha256: String::new(), path: resolved.clone() }];
        let error = OutputFolder::create(out.path(), "name", &inputs).unwrap_err();
        assert!(matches!(error, FolderError::IsInput { .. }), "{error}");
        assert!(resolved.exists());
    }
}
