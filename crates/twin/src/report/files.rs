//! The output folder of a scenario. Files appear whole or not at all: each is written under a
//! temporary name and renamed.

use std::{
    fs, io,
    path::{Path, PathBuf},
};

use serde::Serialize;

/// Why a result cannot be written.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {}: {source}", .path.display())]
pub struct OutputError {
    /// The file or folder.
    pub path: PathBuf,
    /// The error of the operating system.
    pub source: io::Error,
}

impl OutputError {
    /// Whether the disk is full, in which case another folder does not help.
    pub fn is_full(&self) -> bool {
        matches!(self.source.kind(), io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded)
    }
}

/// The folder that holds one scenario's results.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OutputFolder {
    path: PathBuf,
}

/// All files that a run may write.
const RESULTS: [&str; 11] = [
    "report.json",
    "report.html",
    "report.html.partial",
    "junit.xml",
    "recording.rrd",
    "recording.rrd.partial",
    "trajectory.csv",
    "trajectory.csv.partial",
    "trajectory.parquet",
    "trajectory.parquet.partial",
    "scenario.resolved.toml",
];

impl OutputFolder {
    /// Where the results of a scenario of this name go.
    pub fn path_for(out: &Path, scenario: &str) -> PathBuf {
        out.join(file_name(scenario))
    }

    /// Makes the folder, checks that it can be written, and removes the results of an earlier run.
    ///
    /// # Errors
    /// [`OutputError`] if the folder cannot be made or written.
    pub fn create(out: &Path, scenario: &str) -> Result<Self, OutputError> {
        let folder = Self { path: Self::path_for(out, scenario) };
        fs::create_dir_all(&folder.path).map_err(|source| folder.refused("", source))?;
        RESULTS.iter().try_for_each(|name| folder.remove(name))?;
        Ok(folder)
    }

    /// The folder.
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

    /// Writes a document whole, as JSON.
    ///
    /// # Errors
    /// [`OutputError`] where it cannot be written; the name then does not exist.
    pub fn write_json<T: Serialize>(&self, name: &str, document: &T) -> Result<(), OutputError> {
        let mut json =
            serde_json::to_vec_pretty(document).map_err(|error| self.refused(name, error.into()))?;
        json.push(b'\n');
        self.write(name, &json)
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

/// Writes a file under a temporary name beside it and renames it. A link stays one, and its target is written; a pipe
/// or a device is written as it is.
///
/// # Errors
/// [`OutputError`] if it cannot be written.
pub fn write_whole(path: &Path, contents: &[u8]) -> Result<(), OutputError> {
    let refused = |source| OutputError { path: path.to_owned(), source };
    let is_replaceable = fs::metadata(path).map_or(true, |metadata| metadata.is_file() || metadata.is_dir());
    if !is_replaceable {
        return fs::write(path, contents).map_err(refused);
    }
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let path = target.as_path();
    let mut temporary = path.as_os_str().to_owned();
    temporary.push(".tmp");
    let temporary = PathBuf::from(temporary);
    let written = fs::write(&temporary, contents).and_then(|()| fs::rename(&temporary, path));
    written.map_err(|source| {
        // The remainder is of no use; the first error is the one to report.
        let _ = fs::remove_file(&temporary);
        refused(source)
    })
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
    fn a_file_that_cannot_be_written_leaves_nothing_behind() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("report.json");
        fs::create_dir(&path).unwrap();
        assert!(write_whole(&path, b"{}").is_err());
        let left: Vec<_> =
            fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        assert_eq!(left, ["report.json"]);
    }

    #[cfg(unix)]
    #[test]
    fn links_stay_links_and_devices_devices() {
        let folder = tempfile::tempdir().unwrap();
        let [link, target] = ["link.xml", "target.xml"].map(|name| folder.path().join(name));
        fs::write(&target, "before").unwrap();
        std::os::unix::fs::symlink(&target, &link).unwrap();
        write_whole(&link, b"after").unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read_to_string(&target).unwrap(), "after");
        let device = folder.path().join("null");
        std::os::unix::fs::symlink("/dev/null", &device).unwrap();
        write_whole(&device, b"nothing").unwrap();
        assert_eq!(fs::canonicalize(&device).unwrap(), Path::new("/dev/null"));
    }

    #[test]
    fn a_folder_that_is_a_file_is_refused() {
        let out = std::env::temp_dir().join(format!("congruent-files-{}", std::process::id()));
        fs::write(&out, "a file").unwrap();
        let error = OutputFolder::create(&out, "name").unwrap_err();
        fs::remove_file(&out).unwrap();
        assert!(error.to_string().starts_with("cannot write"), "{error}");
    }
}
