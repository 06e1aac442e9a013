//! The command `congruent` of the package: the library of the command with the arguments of the process.

use std::io::Write;

use pyo3::prelude::*;

/// Does what the command does with these arguments and returns its exit code. It is made for one call in a process.
#[pyfunction]
#[pyo3(signature = (arguments))]
pub(crate) fn run_command(py: Python<'_>, arguments: Vec<String>) -> u8 {
    py.detach(|| {
        // The name of the program is that of the command, however Python calls its script.
        let words = std::iter::once("congruent".to_owned()).chain(arguments);
        let exit_code = congruent_cli::run(words);
        // Python does not flush the standard output of Rust when it ends. There is nothing to be done if that is closed.
        let _ = std::io::stdout().flush();
        exit_code
    })
}
