//! `--plot FILE.svg`: writes the plot of a command.

use std::path::PathBuf;

use congruent::{analysis::plot::PlotError, description::Diagnostic, twin::report::write_whole};

use crate::{failure::Failure, output_file::is_same_file};

/// The file of a plot.
#[derive(Debug, clap::Args)]
pub(crate) struct PlotArgument {
    /// Also write a plot.
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,
}

impl PlotArgument {
    /// Whether a plot is asked for.
    pub(crate) fn is_given(&self) -> bool {
        self.plot.is_some()
    }

    /// The plot replaces none of these files, which are read.
    pub(crate) fn is_none_of(&self, inputs: &[PathBuf]) -> Result<(), Diagnostic> {
        let Some(path) = &self.plot else { return Ok(()) };
        if inputs.iter().any(|input| is_same_file(path, input)) {
            let message = format!("--plot {} is a file that is read", path.display());
            return Err(Diagnostic::error("plot::output", message).with_help("choose another name"));
        }
        Ok(())
    }

    /// Draws and writes the plot if the argument is given.
    pub(crate) fn write(&self, draw: impl FnOnce() -> Result<String, PlotError>) -> Result<(), Failure> {
        let Some(path) = &self.plot else { return Ok(()) };
        let svg = draw().map_err(|error| Failure::Machine(error.to_string()))?;
        write_whole(path, svg.as_bytes()).map_err(|error| {
            Diagnostic::error("plot::output", error.to_string())
                .with_help("choose a file that can be written with --plot")
                .into()
        })
    }
}
