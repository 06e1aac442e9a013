//! The command `congruent`: arguments, printing, exit codes. What it prints is computed in
//! `congruent-twin`. A new command is a file here, a variant of [`Command`] and a line in [`main`].

mod calibrate;
mod check;
mod clearance;
mod convert;
mod derive;
mod failure;
mod fk;
mod ik;
mod input;
#[cfg(feature = "recording")]
mod inspect;
mod jacobian;
mod manipulability;
mod plot_file;
mod print;
mod run;
mod sensitivity;
mod workspace;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::print::{Format, Printer};

/// Is a robot's analytical model the same robot as its URDF? With the difference and its cause.
///
/// Exit codes: 0 all as expected, 1 a check failed, 2 bad input, 3 the simulation or the machine
/// failed, 4 nothing was checked.
#[derive(Debug, Parser)]
#[command(name = "congruent", version, max_term_width = 100)]
struct Arguments {
    /// Print for people, or one JSON document.
    #[arg(long, value_enum, default_value_t = Format::Human, global = true)]
    format: Format,
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Run(run::Arguments),
    Check(check::Arguments),
    Fk(fk::Arguments),
    Jacobian(jacobian::Arguments),
    Ik(ik::Arguments),
    Manipulability(manipulability::Arguments),
    Workspace(workspace::Arguments),
    Sensitivity(sensitivity::Arguments),
    Clearance(clearance::Arguments),
    Calibrate(calibrate::Arguments),
    Derive(derive::Arguments),
    Convert(convert::Arguments),
    #[cfg(feature = "recording")]
    Inspect(inspect::Arguments),
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let printer = Printer::new(arguments.format);
    let result = match arguments.command {
        Command::Run(arguments) => run::run(&arguments, &printer),
        Command::Check(arguments) => check::run(&arguments, &printer),
        Command::Fk(arguments) => fk::run(&arguments, &printer),
        Command::Jacobian(arguments) => jacobian::run(&arguments, &printer),
        Command::Calibrate(arguments) => calibrate::run(&arguments, &printer),
        Command::Ik(arguments) => ik::run(&arguments, &printer),
        Command::Manipulability(arguments) => manipulability::run(&arguments, &printer),
        Command::Workspace(arguments) => workspace::run(&arguments, &printer),
        Command::Sensitivity(arguments) => sensitivity::run(&arguments, &printer),
        Command::Clearance(arguments) => clearance::run(&arguments, &printer),
        Command::Derive(arguments) => derive::run(&arguments, &printer),
        Command::Convert(arguments) => convert::run(&arguments, &printer),
        #[cfg(feature = "recording")]
        Command::Inspect(arguments) => inspect::run(&arguments, &printer),
    };
    match result {
        Ok(code) => ExitCode::from(code),
        Err(failure) => {
            printer.failure(&failure);
            ExitCode::from(failure.exit_code())
        }
    }
}
