//! `--plot FILE.svg`: writes the plot of a command.

use std::{
    fmt::Display,
    path::{Path, PathBuf},
};

use congruent::input::Diagnostic;

use crate::{
    codes,
    failure::Failure,
    output::file::{refuse_inputs, replace},
};

/// The file of a plot.
#[derive(Debug, clap::Args)]
pub(crate) struct PlotArgument {
    /// Also write a plot.
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,
}

impl PlotArgument {
    /// The file with its option, if it is wanted.
    pub(crate) fn output(&self) -> Option<(&'static str, &Path)> {
        Some(("--plot", self.plot.as_deref()?))
    }

    /// Whether `--plot` is given.
    pub(crate) fn is_given(&self) -> bool {
        self.plot.is_some()
    }

    /// The plot replaces none of these files, which are read, and its name says what it is.
    pub(crate) fn is_none_of(&self, inputs: &[PathBuf]) -> Result<(), Diagnostic> {
        let Some(path) = &self.plot else { return Ok(()) };
        refuse_inputs("--plot", path, inputs)?;
        let extension = path.extension().unwrap_or_default();
        if !extension.is_empty() && !extension.eq_ignore_ascii_case("svg") {
            let message =
                format!("--plot {}: a plot is an SVG file, so its name must end in .svg", path.display());
            return Err(
                Diagnostic::error(codes::output::REFUSED, message).with_help("give a file that ends in .svg")
            );
        }
        Ok(())
    }

    /// Draws and writes the plot if the argument is given.
    pub(crate) fn write<E: Display>(
        &self,
        draw: impl FnOnce() -> Result<String, E>,
        inputs: &[PathBuf],
    ) -> Result<(), Failure> {
        let Some(path) = &self.plot else { return Ok(()) };
        let svg = draw().map_err(|error| Failure::Machine(error.to_string()))?;
        replace("--plot", path, &svg, inputs)
    }
}
