//! The program `congruent`: the library `congruent_cli` with the arguments of the process.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(congruent_cli::run(std::env::args_os()))
}
