//! The folder of a sweep: `sweep.json` says what its rows are of, `rows/` has them in one file for each call.
//!
//! Calls on one folder need no lock: each writes a file of its own, whose lines are complete or, after a kill, missing.

use std::{
    fs::{self, File},
    io::{self, Write},
    path::{Path, PathBuf},
};

use congruent_input::Diagnostic;
use congruent_results::files::write_whole;

use super::{cases::CaseRange, header::SweepHeader};
use crate::{codes, run::CaseRow};

/// The file that says what the rows are of.
const HEADER: &str = "sweep.json";
/// The folder of the rows.
const ROWS: &str = "rows";
/// Most calls that may write rows of the same range.
const MOST_CALLS: u32 = 1_000_000;

/// The folder of a sweep.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SweepFolder {
    path: PathBuf,
}

/// Writes rows to a file of its own, each as soon as it is there.
#[derive(Debug)]
pub struct RowWriter {
    file: File,
    path: PathBuf,
}

impl SweepFolder {
    /// The folder at this path, which need not exist.
    pub fn at(path: &Path) -> Self {
        Self { path: path.to_owned() }
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What its rows are of; `None` if nothing has been written yet.
    ///
    /// # Errors
    /// The file cannot be read, or is none of this program.
    pub fn header(&self) -> Result<Option<SweepHeader>, Diagnostic> {
        let path = self.path.join(HEADER);
        let text = match fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(congruent_input::unreadable(&path, &error)),
        };
        serde_json::from_str(&text).map(Some).map_err(|error| {
            let message = format!("{}: not what the rows of a sweep are of: {error}", path.display());
            Diagnostic::error(codes::sweep::ROWS, message)
        })
    }

    /// Makes the folder for rows of this header, if it is not there.
    ///
    /// # Errors
    /// It has rows of another plan, or cannot be written.
    pub fn begin(&self, header: &SweepHeader) -> Result<(), Diagnostic> {
        if let Some(known) = self.header()? {
            return if known.identity == header.identity {
                Ok(())
            } else {
                Err(self.other_plan(&known, header))
            };
        }
        let write = || {
            fs::create_dir_all(self.path.join(ROWS))?;
            let text = serde_json::to_string_pretty(header)? + "\n";
            // Another call that begins at the same time reads all of it or nothing.
            write_whole(&self.path.join(HEADER), text.as_bytes()).map_err(|error| error.source)
        };
        write().map_err(|error: io::Error| unwritable(&self.path, &error))
    }

    fn other_plan(&self, known: &SweepHeader, header: &SweepHeader) -> Diagnostic {
        let differs = |what: &str, differs: bool| differs.then(|| what.to_owned());
        let files = header.files.iter().filter(|(name, digest)| known.files.get(*name) != Some(digest));
        let differences: Vec<String> = [
            differs("another version of this program", known.versions != header.versions),
            differs("another number of cases", known.cases != header.cases),
            differs("another seed", known.seed != header.seed),
            differs("other keys", known.keys != header.keys),
        ]
        .into_iter()
        .flatten()
        .chain(files.map(|(name, _)| format!("another {name}")))
        .collect();
        let differences =
            if differences.is_empty() { "another plan".to_owned() } else { differences.join(", ") };
        let message = format!("{} has rows of {differences}", self.path.display());
        Diagnostic::error(codes::sweep::OTHER_PLAN, message)
            .with_help("choose another --out, or remove that folder: rows of different sweeps make no table")
    }

    /// The files of rows, in the order of their names.
    ///
    /// # Errors
    /// The folder cannot be read.
    pub fn row_files(&self) -> Result<Vec<PathBuf>, Diagnostic> {
        let folder = self.path.join(ROWS);
        let entries = fs::read_dir(&folder).map_err(|error| congruent_input::unreadable(&folder, &error))?;
        let is_rows = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "jsonl");
        let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).filter(is_rows).collect();
        files.sort();
        Ok(files)
    }

    /// A new file for rows of this range.
    ///
    /// # Errors
    /// It cannot be made.
    pub fn writer(&self, range: CaseRange) -> Result<RowWriter, Diagnostic> {
        for call in 0..MOST_CALLS {
            let name = format!("{:012}-{:012}-{call}.jsonl", range.first, range.end);
            let path = self.path.join(ROWS).join(name);
            match File::options().append(true).create_new(true).open(&path) {
                Ok(file) => return Ok(RowWriter { file, path }),
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(unwritable(&path, &error)),
            }
        }
        Err(unwritable(&self.path, &io::Error::other("too many calls have written rows of this range")))
    }
}

impl RowWriter {
    /// Writes one row as one line.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn write(&mut self, row: &CaseRow) -> Result<(), Diagnostic> {
        // One call of the system for the whole line, so that lines are whole after a kill.
        let line = serde_json::to_string(row).map(|line| line + "\n").map_err(io::Error::from);
        line.and_then(|line| self.file.write_all(line.as_bytes()))
            .map_err(|error| unwritable(&self.path, &error))
    }
}

fn unwritable(path: &Path, error: &io::Error) -> Diagnostic {
    let message = format!("{} cannot be written: {error}", path.display());
    Diagnostic::error(codes::sweep::WRITE, message)
}
