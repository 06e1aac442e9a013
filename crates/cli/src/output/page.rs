//! `--html FILE`: writes the report of a command as a page.

use std::{
    ffi::OsStr,
    path::{Path, PathBuf},
};

use congruent::input::Diagnostic;

use crate::{
    codes,
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

    /// The page replaces none of these files, which are read, and its name says what it is: a browser shows the markup of a
    /// file with another ending.
    pub(crate) fn is_none_of(&self, inputs: &[PathBuf]) -> Result<(), Diagnostic> {
        let Some(path) = &self.html else { return Ok(()) };
        refuse_inputs("--html", path, inputs)?;
        let is_html = |end: &OsStr| ["html", "htm"].iter().any(|known| end.eq_ignore_ascii_case(known));
        if path.extension().is_some_and(is_html) {
            return Ok(());
        }
        let message =
            format!("--html {}: a page is an HTML file, so its name must end in .html", path.display());
        Err(Diagnostic::error(codes::output::REFUSED, message).with_help("give a file that ends in .html"))
    }

    /// Makes and writes the page if the argument is given.
    pub(crate) fn write(&self, page: impl FnOnce() -> String, inputs: &[PathBuf]) -> Result<(), Failure> {
        self.html.as_ref().map_or(Ok(()), |path| replace("--html", path, page(), inputs))
    }
}
