//! Repository chores: `cargo run --release -p xtask -- tidy`.

#![expect(clippy::print_stderr, reason = "a chore talks to its user")]

use std::process::{Command, ExitCode};

fn main() -> ExitCode {
    if std::env::args().nth(1).as_deref() == Some("tidy") {
        return tidy();
    }
    eprintln!("usage: xtask tidy    keeps the architecture's arrows, its map, the words and the names true");
    ExitCode::from(2)
}

/// Formats the sources and runs the tests of `tests/`: the map, circles of imports, words and names.
fn tidy() -> ExitCode {
    let chores: [&[&str]; 2] = [&["fmt", "--all"], &["test", "--release", "--package", "xtask"]];
    for arguments in chores {
        match Command::new(env!("CARGO")).args(arguments).status() {
            Ok(status) if status.success() => {}
            Ok(_) => return ExitCode::FAILURE,
            Err(error) => {
                eprintln!("cargo {}: {error}", arguments.join(" "));
                return ExitCode::FAILURE;
            }
        }
    }
    ExitCode::SUCCESS
}
