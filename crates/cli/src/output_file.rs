//! Files that a command makes, such as the model of `--out FILE`. A file appears whole or not at all, and nothing is
//! overwritten that the user did not mean.

use std::{
    fs::{self, File, OpenOptions},
    io::{self, Write},
    path::{Path, PathBuf},
};

use congruent::description::Diagnostic;

use crate::failure::Failure;

/// Where a model is written.
#[derive(Debug, clap::Args)]
pub(crate) struct OutputArgument {
    /// Write the model to this file instead of printing it: a table as a whole robot file (.toml).
    #[arg(long, alias = "output", value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Replace the file of --out if it exists.
    #[arg(long, requires = "out")]
    force: bool,
}

impl OutputArgument {
    /// Writes `text` to `path`, which is none of the files `inputs`; if `accept` refuses the written file, what
    /// was there before is there again.
    pub(crate) fn write(
        &self,
        path: &Path,
        text: &str,
        inputs: &[PathBuf],
        accept: impl FnOnce(&Path) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        NewFile { option: "--out", path, force: self.force }.write(text, inputs, accept)
    }
}

/// A file that a command makes, at a place that the user gives.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NewFile<'a> {
    /// The option that names it.
    pub(crate) option: &'static str,
    pub(crate) path: &'a Path,
    /// Whether it may replace a file that exists.
    pub(crate) force: bool,
}

impl NewFile<'_> {
    /// Writes `text`; the file is none of the files `inputs`. If `accept` refuses the written file, what was there
    /// before is there again.
    pub(crate) fn write<T>(
        &self,
        text: &str,
        inputs: &[PathBuf],
        accept: impl FnOnce(&Path) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        self.may_be_written(inputs)?;
        let path = self.path;
        let before = fs::read(path).ok();
        whole(path, text.as_bytes()).map_err(|error| unwritable(path, &error))?;
        accept(path).inspect_err(|_| {
            // The refusal is what is reported.
            let _ = before.map_or_else(|| fs::remove_file(path), |before| whole(path, &before));
        })
    }

    /// Finds out at once whether it may be written, before any work.
    pub(crate) fn may_be_written(&self, inputs: &[PathBuf]) -> Result<(), Diagnostic> {
        let Self { option, path, .. } = self;
        let refused = |why: &str, help: &str| {
            Err(Diagnostic::error("output::refused", format!("{option} {} {why}", path.display()))
                .with_help(help))
        };
        if path.is_dir() {
            return refused("is a folder", "give the name of a file in it");
        }
        if inputs.iter().any(|input| is_same_file(path, input)) {
            return refused("is a file that is read", "choose another name");
        }
        if !self.force && path.symlink_metadata().is_ok() {
            return refused("exists", "choose another name, or replace it with --force");
        }
        Ok(())
    }
}

/// The folder of a file, as an absolute path without links.
pub(crate) fn folder_of(path: &Path) -> Result<PathBuf, Diagnostic> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    folder.canonicalize().map_err(|error| unwritable(path, &error))
}

fn unwritable(path: &Path, error: &io::Error) -> Diagnostic {
    Diagnostic::error("output::unwritable", format!("cannot write {}: {error}", path.display()))
        .with_help("choose a file in a folder that exists and can be written")
}

/// Whether two paths lead to one file, by links of either kind.
pub(crate) fn is_same_file(a: &Path, b: &Path) -> bool {
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

/// Writes a new file beside `path`, under a name that nobody has, and renames it.
fn whole(path: &Path, contents: &[u8]) -> io::Result<()> {
    let name = path.file_name().ok_or(io::ErrorKind::InvalidFilename)?.to_string_lossy();
    let temporary = path.with_file_name(format!(".{name}.{}.tmp", std::process::id()));
    let mut file: File = OpenOptions::new().write(true).create_new(true).open(&temporary)?;
    let written = file.write_all(contents).and_then(|()| fs::rename(&temporary, path));
    written.inspect_err(|_| {
        // The remainder is of no use; the first error is the one to report.
        let _ = fs::remove_file(&temporary);
    })
}
