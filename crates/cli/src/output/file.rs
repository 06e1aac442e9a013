//! Files that a command makes, such as the model of `convert --to FILE`. A file appears whole or not at all, and nothing is
//! overwritten that the user did not mean.

use std::{
    fs, io,
    path::{Path, PathBuf},
};

use congruent::{
    input::Diagnostic,
    results::files::{OutputError, is_same_file, write_whole},
};

use crate::{
    codes,
    failure::{self, Failure},
};

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
        write_whole(path, text.as_bytes()).map_err(|error| failure::unwritable(&error, FOLDER))?;
        accept(path).inspect_err(|_| {
            // The refusal is what is reported.
            match before {
                Some(before) => drop(write_whole(path, &before)),
                None => drop(fs::remove_file(path)),
            }
        })
    }

    /// Finds out at once whether it may be written, before any work.
    pub(crate) fn may_be_written(&self, inputs: &[PathBuf]) -> Result<(), Diagnostic> {
        let Self { option, path, .. } = self;
        let refused = |why: &str, help: &str| {
            Err(Diagnostic::error(codes::output::REFUSED, format!("{option} {} {why}", path.display()))
                .with_help(help))
        };
        if path.is_dir() {
            return refused("is a folder", "give the name of a file in it");
        }
        refuse_inputs(option, path, inputs)?;
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

pub(crate) fn unwritable(path: &Path, error: &io::Error) -> Diagnostic {
    Diagnostic::error(codes::output::UNWRITABLE, format!("cannot write {}: {error}", path.display()))
        .with_help(FOLDER)
}

const FOLDER: &str = "choose a file in a folder that exists and can be written";

/// No two options name one file: the second would replace the result of the first.
pub(crate) fn refuse_same<'a>(
    outputs: impl IntoIterator<Item = (&'static str, &'a Path)>,
) -> Result<(), Diagnostic> {
    let outputs: Vec<_> = outputs.into_iter().collect();
    let place = |path: &Path| Some((folder_of(path).ok()?, path.file_name()?.to_owned()));
    let is_same = |one: &Path, other: &Path| {
        one == other || is_same_file(one, other) || place(one).is_some_and(|at| Some(at) == place(other))
    };
    for (at, (option, path)) in outputs.iter().enumerate() {
        if let Some((other, _)) = outputs[..at].iter().find(|(_, before)| is_same(before, path)) {
            let message = format!("{other} and {option} name the same file, {}", path.display());
            return Err(
                Diagnostic::error(codes::output::REFUSED, message).with_help("give each a file of its own")
            );
        }
    }
    Ok(())
}

/// No result replaces a file that is read.
pub(crate) fn refuse_inputs(option: &str, path: &Path, inputs: &[PathBuf]) -> Result<(), Diagnostic> {
    if !inputs.iter().any(|input| is_same_file(path, input)) {
        return Ok(());
    }
    let message = format!("{option} {} is an input file", path.display());
    Err(Diagnostic::error(codes::output::REFUSED, message)
        .with_help("inputs are not overwritten: choose another name"))
}

/// Writes what an option asks for, whole, in a folder that is made if there is none; it replaces any file but those of
/// `inputs`.
pub(crate) fn replace(
    option: &str,
    path: &Path,
    contents: impl AsRef<[u8]>,
    inputs: &[PathBuf],
) -> Result<(), Failure> {
    refuse_inputs(option, path, inputs)?;
    let refused = |error: OutputError| {
        failure::unwritable(&error, &format!("choose a file that can be written with {option}"))
    };
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)
            .map_err(|source| refused(OutputError { path: path.to_owned(), source }))?;
    }
    write_whole(path, contents.as_ref()).map_err(refused)
}
