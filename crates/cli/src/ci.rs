//! What CI reads of a call: a JUnit file, a summary in Markdown, and annotations at lines.

use std::{
    fs::{self, File, OpenOptions},
    io::{self, Read, Write},
    path::{Path, PathBuf},
};

use clap::ValueEnum;
use congruent::{
    input::Diagnostic,
    results::report::{TestSuite, github_annotations, step_summary, write_junit},
};

use crate::{
    codes,
    failure::{Failure, unwritable},
    output::file::{refuse_inputs, refuse_same},
    terminal::print::Printer,
};

/// Names of the folder that a CI host has cloned the repository to.
const CLONES: [&str; 3] = ["GITHUB_WORKSPACE", "CI_PROJECT_DIR", "WORKSPACE"];

/// Bytes within which the root element of a JUnit file begins.
const HEAD_BYTES: u64 = 4096;

/// Files and lines for CI.
#[derive(Debug, Default, Clone, clap::Args)]
pub(crate) struct CiArguments {
    /// Also write one JUnit file: a suite for each input, a case for each check of it, and an error for each input
    /// that could not start. Its times are those of the machine.
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Also append a summary in Markdown to this file, the worst first: on GitHub, --summary `"$GITHUB_STEP_SUMMARY"`.
    #[arg(long, value_name = "FILE")]
    summary: Option<PathBuf>,
    /// Also print failures to standard error in the form of a CI host, which shows them at their lines; what changes since a
    /// revision is a notice.
    #[arg(long, value_enum, value_name = "HOST")]
    annotate: Option<Host>,
}

/// The CI host whose form of annotations is printed.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Host {
    /// Workflow commands of GitHub Actions: `::error file=...,line=...::message`, or `::notice` for a change.
    Github,
}

impl CiArguments {
    /// A JUnit file alone.
    #[cfg(test)]
    pub(crate) fn with_junit(path: &Path) -> Self {
        Self { junit: Some(path.to_owned()), ..Self::default() }
    }

    /// The files, each with its option.
    pub(crate) fn outputs(&self) -> impl Iterator<Item = (&'static str, &Path)> {
        let files = [("--junit", &self.junit), ("--summary", &self.summary)];
        files.into_iter().filter_map(|(option, path)| Some((option, path.as_deref()?)))
    }

    /// The files replace none of these, which are read.
    pub(crate) fn is_none_of(&self, inputs: &[PathBuf]) -> Result<(), Diagnostic> {
        self.outputs().try_for_each(|(option, path)| refuse_inputs(option, path, inputs))
    }

    /// Finds out at once whether the files can be written, and that they replace none of `inputs`. Until the end the JUnit
    /// file has these suites.
    pub(crate) fn begin(&self, inputs: &[PathBuf], unfinished: &[TestSuite]) -> Result<(), Failure> {
        self.is_none_of(inputs)?;
        refuse_same(self.outputs())?;
        if let Some(path) = &self.junit {
            is_junit(path)?;
        }
        self.write_unfinished(unfinished)?;
        if let Some(path) = &self.summary {
            append_to(path, "").map_err(|error| {
                let message = format!("cannot write {}: {error}", path.display());
                Diagnostic::error(codes::run::OUTPUT, message).with_help("choose another file with --summary")
            })?;
        }
        Ok(())
    }

    /// Writes the JUnit file if one is asked for; `begin` has found that it may be written.
    pub(crate) fn write_unfinished(&self, suites: &[TestSuite]) -> Result<(), Failure> {
        let Some(path) = &self.junit else { return Ok(()) };
        write_junit(path, suites).map_err(|error| unwritable(&error, "choose another file with --junit"))
    }

    /// Whether `--junit` is given.
    pub(crate) fn has_junit(&self) -> bool {
        self.junit.is_some()
    }

    /// Whether any option for CI is given.
    pub(crate) fn is_wanted(&self) -> bool {
        self.junit.is_some() || self.summary.is_some() || self.annotate.is_some()
    }

    /// Writes the files of all options that are given; one that cannot be written does not stop the others.
    pub(crate) fn finish(&self, suites: &[TestSuite], inputs: &[PathBuf]) -> Vec<Failure> {
        let junit = self.junit.as_deref().and_then(|path| write_junit(path, suites).err());
        if let Some(Host::Github) = self.annotate {
            Printer::annotations(&github_annotations(suites));
        }
        let append = |path: &PathBuf| {
            let error = append_to(path, &step_summary(suites)).err()?;
            Some(format!("cannot write {}: {error}", path.display()))
        };
        // Checked again, since the inputs have named further files since `begin`.
        let summary = self.summary.as_ref().filter(|path| refuse_inputs("--summary", path, inputs).is_ok());
        let summary = summary.and_then(append);
        junit.map(|error| error.to_string()).into_iter().chain(summary).map(Failure::Machine).collect()
    }
}

/// The suite with its files named from the top of the repository, by which code hosts find them: the folder that the host
/// says, else the nearest with `.git` at or above the current one. Files elsewhere keep their names.
pub(crate) fn in_repository(mut suite: TestSuite) -> TestSuite {
    let Some(top) = top_of_repository() else { return suite };
    let of_cases = suite
        .cases
        .iter_mut()
        .flat_map(|case| case.place.iter_mut().chain(case.further.iter_mut().map(|(place, _)| place)));
    let of_change = suite.change.iter_mut().flat_map(|change| &mut change.places).map(|(place, _)| place);
    for place in of_cases.chain(of_change) {
        if let Some(inside) = inside(Path::new(&place.file), &top) {
            let parts: Vec<_> = inside.iter().map(|part| part.to_string_lossy()).collect();
            place.file = parts.join("/");
        }
    }
    suite
}

/// A file by its path from a folder; `None` if it is not in it.
pub(crate) fn inside(file: &Path, folder: &Path) -> Option<PathBuf> {
    file.canonicalize().ok()?.strip_prefix(folder).ok().map(Path::to_owned)
}

/// The top of the repository that a call is made in.
pub(crate) fn top_of_repository() -> Option<PathBuf> {
    let stated = CLONES.into_iter().filter_map(std::env::var_os).map(PathBuf::from);
    let current = std::env::current_dir().ok()?;
    let above = current.ancestors().find(|folder| folder.join(".git").exists()).map(Path::to_owned);
    // A host may state the folder of another checkout: only one that the call is made in counts.
    let is_here = |top: &PathBuf| current.starts_with(top);
    stated.filter_map(|top| top.canonicalize().ok()).find(is_here).or_else(|| above?.canonicalize().ok())
}

/// Appends to a file; makes it and its folder.
fn append_to(path: &Path, text: &str) -> io::Result<()> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    OpenOptions::new().append(true).create(true).open(path)?.write_all(text.as_bytes())
}

/// A JUnit file is written before the inputs are read that other files name, so it replaces only what is one.
fn is_junit(path: &Path) -> Result<(), Diagnostic> {
    let Ok(metadata) = fs::metadata(path) else { return Ok(()) };
    if !metadata.is_file() || metadata.len() == 0 {
        return Ok(());
    }
    let mut head = Vec::new();
    let read = File::open(path).and_then(|file| file.take(HEAD_BYTES).read_to_end(&mut head));
    if read.is_ok() && String::from_utf8_lossy(&head).contains("<testsuite") {
        return Ok(());
    }
    let message = format!("--junit {} exists and is not a JUnit file", path.display());
    Err(Diagnostic::error(codes::output::REFUSED, message)
        .with_help("choose another name, or remove the file"))
}
