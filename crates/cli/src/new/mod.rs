//! `congruent new`: files to start from.

mod robot;
mod scenario;

use crate::{failure::Failure, terminal::print::Printer};

/// Files to start from: a robot file for a URDF, a scenario for a robot.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    what: NewCommand,
}

#[derive(Debug, clap::Subcommand)]
enum NewCommand {
    Robot(robot::Arguments),
    Scenario(scenario::Arguments),
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    match &arguments.what {
        NewCommand::Robot(arguments) => robot::run(arguments, printer),
        NewCommand::Scenario(arguments) => scenario::run(arguments, printer),
    }
}
