//! `--html FILE`: writes the report of a command as a page.

use std::path::{Path, PathBuf};

use congruent::input::Diagnostic;

use crate::{
    failure::Failure,
    output::file::{refuse_inputs, replace},
};

/// The file of a page.
#[derive(Debug, clap::Args)]
pub(crate) struct PageArgument {
    /// Also write the report as a page: one file that opens in any browser and needs no network.
    #[arg(long, value_name = "FILE.html")]
    html: Option<PathBuf>,
}

impl PageArgument {
    /// The file with its option, if it is wanted.
    pub(crate) fn output(&self) -> Option<(&'static str, &Path)> {
        Some(("--html", self.html.as_deref()?))
    }

    /// The page replaces none of these files, which are read.
    pub(crate) fn is_none_of(&self, inputs: &[PathBuf]) -> Result<(), Diagnostic> {
        self.html.as_ref().map_or(Ok(()), |path| refuse_inputs("--html", path, inputs))
    }

    /// Makes and writes the page if the argument is given.
    pub(crate) fn write(&self, page: impl FnOnce() -> String, inputs: &[PathBuf]) -> Result<(), Failure> {
        self.html.as_ref().map_or(Ok(()), |path| replace("--html", path, page(), inputs))
    }
}
