//! The command `congruent`: arguments, printing, exit codes. What it prints is computed in
//! the library `congruent`. A new command is a file here or in a folder, a variant of [`Command`] and a line in [`main`].

mod arm;
mod batch;
mod ci;
mod compare;
mod failure;
mod faults;
mod input;
#[cfg(feature = "recording")]
mod inspect;
mod interrupt;
mod model;
mod new;
mod output_file;
mod page_file;
mod plot_file;
mod print;
mod run;
mod schema;
mod table;

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
    Faults(faults::Arguments),
    Check(model::check::Arguments),
    Describe(model::describe::Arguments),
    Fk(arm::fk::Arguments),
    Jacobian(arm::jacobian::Arguments),
    Ik(arm::ik::Arguments),
    Dynamics(arm::dynamics::Arguments),
    Manipulability(arm::manipulability::Arguments),
    Workspace(arm::workspace::Arguments),
    Sensitivity(arm::sensitivity::Arguments),
    Clearance(arm::clearance::Arguments),
    Acm(arm::acm::Arguments),
    Calibrate(model::calibrate::Arguments),
    New(new::Arguments),
    Derive(model::derive::Arguments),
    Convert(model::convert::Arguments),
    #[cfg(feature = "recording")]
    Inspect(inspect::Arguments),
    Compare(compare::Arguments),
    Schema(schema::Arguments),
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let printer = Printer::new(arguments.format);
    let result = match arguments.command {
        Command::Run(arguments) => run::run(&arguments, &printer),
        Command::Faults(arguments) => faults::run(&arguments, &printer),
        Command::Check(arguments) => model::check::run(&arguments, &printer),
        Command::Describe(arguments) => model::describe::run(&arguments, &printer),
        Command::Fk(arguments) => arm::fk::run(&arguments, &printer),
        Command::Jacobian(arguments) => arm::jacobian::run(&arguments, &printer),
        Command::Calibrate(arguments) => model::calibrate::run(&arguments, &printer),
        Command::Dynamics(arguments) => arm::dynamics::run(&arguments, &printer),
        Command::Ik(arguments) => arm::ik::run(&arguments, &printer),
        Command::Manipulability(arguments) => arm::manipulability::run(&arguments, &printer),
        Command::Workspace(arguments) => arm::workspace::run(&arguments, &printer),
        Command::Sensitivity(arguments) => arm::sensitivity::run(&arguments, &printer),
        Command::Clearance(arguments) => arm::clearance::run(&arguments, &printer),
        Command::Acm(arguments) => arm::acm::run(&arguments, &printer),
        Command::New(arguments) => new::run(&arguments, &printer),
        Command::Derive(arguments) => model::derive::run(&arguments, &printer),
        Command::Convert(arguments) => model::convert::run(&arguments, &printer),
        #[cfg(feature = "recording")]
        Command::Inspect(arguments) => inspect::run(&arguments, &printer),
        Command::Compare(arguments) => compare::run(&arguments, &printer),
        Command::Schema(arguments) => schema::run(&arguments, &printer),
    };
    match result {
        Ok(code) => ExitCode::from(code),
        Err(failure) => {
            printer.failure(&failure);
            ExitCode::from(failure.exit_code())
        }
    }
}
