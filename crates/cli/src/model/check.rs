//! `congruent check`: compares model, URDF and physics.

use std::path::PathBuf;

use congruent::{
    agreement::compare::{Agreement, CheckOptions, CheckReport},
    description::{Diagnostic, load_robot_with, read_configurations},
};

use super::check_text::{basics, text};
use crate::{
    failure::{FAILED, Failure, NOTHING},
    input::{ChainArguments, PackageArguments, with_warning},
    print::Printer,
};

/// Whether a robot's table, its URDF and its physics twin are the same robot.
///
/// Compared at zero, one axis at a time, at 200 seeded random configurations within the limits,
/// at the limits, and at the worst configurations of the certificates. Exit code 1 if they disagree, 4 if
/// there is neither a table nor a robot that can be simulated, so that nothing was compared.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Folders with robot.toml, robot files, bare .urdf files, or - for a URDF on standard input.
    #[arg(required = true)]
    robots: Vec<PathBuf>,
    #[command(flatten)]
    chain: ChainArguments,
    /// Seed of the random configurations.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Compare at the configurations of this file as well and show the difference at each: a JSON array of
    /// {"q": {"joint": value}} in rad and m; joints that are not named are at 0.
    #[arg(long, value_name = "FILE")]
    configurations: Option<PathBuf>,
    /// Also show the pose of the TCP at zero and its motion with each joint; JSON always has both.
    #[arg(long)]
    basics: bool,
    #[command(flatten)]
    packages: PackageArguments,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let mut reports = Vec::with_capacity(arguments.robots.len());
    let ros = arguments.packages.ros();
    for path in &arguments.robots {
        let mut description = arguments.chain.choose(load_robot_with(path, &ros)?, printer)?;
        let configurations = match &arguments.configurations {
            Some(path) => {
                let read = read_configurations(path, &description.robot)?;
                with_warning(read, &mut description, printer)
            }
            None => Vec::new(),
        };
        let report =
            congruent::check(&description, &CheckOptions { seed: arguments.seed, configurations })
                .map_err(|error| Diagnostic::error("check::robot", format!("{}: {error}", path.display())))?;
        reports.push(report);
    }
    let text = |report: &CheckReport| {
        let basics = if arguments.basics { basics(&report.basics) } else { String::new() };
        text(report) + &basics
    };
    let code =
        reports.iter().map(exit_code).max_by_key(|code| FROM_BEST.iter().position(|known| known == code));
    match &reports[..] {
        [report] => printer.result(report, text)?,
        reports => printer.result(&reports, |reports| reports.iter().map(text).collect())?,
    }
    Ok(code.unwrap_or(NOTHING))
}

/// Exit codes of a check, the best first.
const FROM_BEST: [u8; 3] = [0, FAILED, NOTHING];

fn exit_code(report: &CheckReport) -> u8 {
    match report.verdict {
        Agreement::Agree => 0,
        Agreement::Disagree => FAILED,
        Agreement::NothingCompared => NOTHING,
    }
}
