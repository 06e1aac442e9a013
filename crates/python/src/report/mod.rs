//! Reports of checks and runs for Python, with the text that the command prints of them.

mod checks;
mod class;
mod runs;
mod series;
mod toml_value;

pub(crate) use checks::check;
pub(crate) use class::PythonReport;
pub(crate) use runs::run;
