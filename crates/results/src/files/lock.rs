//! One run at a time writes to a folder.

use std::{
    fs::{self, File, TryLockError},
    io::{self, Read, Write},
    path::{Path, PathBuf},
};

/// The file that is locked while a run writes to its folder; it says which run.
const NAME: &str = ".congruent.lock";
/// Longest text of a lock that is shown.
const LONGEST: u64 = 200;

/// How often a file that vanishes is opened again.
const MOST_TRIES: usize = 100;

/// A folder that is locked until this is dropped; the operating system unlocks it if the process is killed.
#[derive(Debug)]
pub(super) struct FolderLock {
    path: PathBuf,
    file: File,
}

/// Why a folder is not locked.
pub(super) enum LockError {
    /// By whom it is.
    Held(String),
    Io(io::Error),
}

impl From<io::Error> for LockError {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

impl FolderLock {
    /// Locks a folder for a scenario.
    pub(super) fn take(folder: &Path, scenario: &str) -> Result<Self, LockError> {
        let path = folder.join(NAME);
        for _ in 0..MOST_TRIES {
            if path.is_symlink() {
                return Err(io::Error::other(format!("{NAME} is a link")).into());
            }
            let mut file = File::options().read(true).write(true).create(true).truncate(false).open(&path)?;
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::Error(error)) => return Err(error.into()),
                Err(TryLockError::WouldBlock) => {
                    let mut holder = String::new();
                    let read = (&file).take(LONGEST).read_to_string(&mut holder);
                    let is_known = read.is_ok() && !holder.is_empty();
                    return Err(LockError::Held(if is_known { holder } else { "another run".to_owned() }));
                }
            }
            if fs::metadata(&path).is_ok_and(|there| is_of(&file, &there)) {
                file.set_len(0)?;
                write!(file, "scenario \"{scenario}\" of process {}", std::process::id())?;
                return Ok(Self { path, file });
            }
            // The run before has ended between opening and locking, and has removed the file.
        }
        Err(LockError::Held("another run".to_owned()))
    }
}

#[cfg(unix)]
fn is_of(file: &File, there: &fs::Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    file.metadata().is_ok_and(|own| (own.dev(), own.ino()) == (there.dev(), there.ino()))
}

#[cfg(not(unix))]
fn is_of(_: &File, _: &fs::Metadata) -> bool {
    true
}

impl Drop for FolderLock {
    fn drop(&mut self) {
        // What stays is no lock.
        let _ = fs::remove_file(&self.path);
        let _ = self.file.unlock();
    }
}
