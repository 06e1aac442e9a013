//! Files that appear whole or not at all: each is written under a temporary name and renamed.

use std::{
    collections::{BTreeSet, hash_map::RandomState},
    fs,
    hash::{BuildHasher, Hasher},
    io::{self, Write},
    path::{Path, PathBuf},
    sync::{LazyLock, Mutex, MutexGuard, PoisonError},
};

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
    /// Whether there is no room: a full disk or a limit of the user, in which case another folder does not help.
    pub fn is_full(&self) -> bool {
        use io::ErrorKind::{FileTooLarge, QuotaExceeded, StorageFull};
        matches!(self.source.kind(), StorageFull | QuotaExceeded | FileTooLarge)
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
    let written = write_beside(path, contents);
    written.map_err(refused)
}

/// Writes a new file beside `path` and renames it. The new file is no link that someone has put there before.
fn write_beside(path: &Path, contents: &[u8]) -> io::Result<()> {
    let name = path.file_name().ok_or(io::ErrorKind::InvalidFilename)?.to_string_lossy();
    let temporary = path.with_file_name(format!(".{name}.{}.tmp", own_number()));
    unfinished().insert(temporary.clone());
    let written = fs::File::create_new(&temporary)
        .and_then(|mut file| file.write_all(contents))
        .and_then(|()| fs::rename(&temporary, path));
    if written.is_err() {
        // The remainder is of no use; the first error is the one to report.
        let _ = fs::remove_file(&temporary);
    }
    unfinished().remove(&temporary);
    written
}

/// A number that no other process has. The number of the process is none: those of containers that share a folder are often equal.
fn own_number() -> u64 {
    static NUMBER: LazyLock<u64> = LazyLock::new(|| RandomState::new().build_hasher().finish());
    *NUMBER
}

/// Whether a file in the folder of a result is what a process writes before it renames it to the result.
pub(super) fn is_temporary_of(result: &str, name: &str) -> bool {
    let number = name
        .strip_prefix('.')
        .and_then(|name| name.strip_prefix(result)?.strip_prefix('.')?.strip_suffix(".tmp"));
    number.is_some_and(|number| !number.is_empty() && number.bytes().all(|digit| digit.is_ascii_digit()))
}

/// The temporary files of this process.
fn unfinished() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    static FILES: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
    FILES.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes the temporary files of this process, which is about to end. No other is begun.
pub fn remove_unfinished_files() {
    let files = unfinished();
    for file in files.iter() {
        let _ = fs::remove_file(file);
    }
    std::mem::forget(files);
}

/// Whether two paths lead to one file, by links of either kind.
pub fn is_same_file(a: &Path, b: &Path) -> bool {
    match (a.canonicalize(), b.canonicalize()) {
        (Ok(a), Ok(b)) => a == b || is_same_inode(&a, &b),
        _ => false,
    }
}

#[cfg(unix)]
fn is_same_inode(a: &Path, b: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let inode = |path: &Path| fs::metadata(path).map(|metadata| (metadata.dev(), metadata.ino())).ok();
    inode(a).is_some_and(|a| Some(a) == inode(b))
}

#[cfg(not(unix))]
fn is_same_inode(_: &Path, _: &Path) -> bool {
    false
}

#[cfg(test)]
mod tests {
    use super::*;

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

    #[test]
    fn temporary_files_are_those_of_a_result_and_a_process() {
        assert!(is_temporary_of("report.json", ".report.json.30245.tmp"));
        for name in [
            "report.json",
            ".report.json.tmp",
            ".report.json.a.tmp",
            ".other.json.1.tmp",
            ".report.json.1.tmp2",
        ] {
            assert!(!is_temporary_of("report.json", name), "{name}");
        }
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
    fn links_of_both_kinds_lead_to_one_file() {
        let folder = tempfile::tempdir().unwrap();
        let [file, hard, other] = ["file", "hard", "other"].map(|name| folder.path().join(name));
        fs::write(&file, "same").unwrap();
        fs::write(&other, "same").unwrap();
        fs::hard_link(&file, &hard).unwrap();
        assert!(is_same_file(&file, &hard) && !is_same_file(&file, &other));
        assert!(!is_same_file(&file, &folder.path().join("none")));
    }
}
