//! `--html FILE`: writes the report of a command as a page.

use std::path::PathBuf;

use congruent::twin::report::write_whole;

use crate::failure::{Failure, unwritable};

/// The file of a page.
#[derive(Debug, clap::Args)]
pub(crate) struct PageArgument {
    /// Also write the report as a page: one file that opens in any browser and needs no network.
    #[arg(long, value_name = "FILE.html")]
    html: Option<PathBuf>,
}

impl PageArgument {
    /// Makes and writes the page if the argument is given.
    pub(crate) fn write(&self, page: impl FnOnce() -> String) -> Result<(), Failure> {
        let Some(path) = &self.html else { return Ok(()) };
        write_whole(path, page().as_bytes())
            .map_err(|error| unwritable(&error, "choose a file that can be written with --html"))
    }
}
