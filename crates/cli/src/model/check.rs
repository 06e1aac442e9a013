//! `congruent check`: compares model, URDF and physics.

use std::path::PathBuf;

use congruent::{
    agreement::compare::{Agreement, CheckOptions, CheckReport},
    description::{Diagnostic, load_robot, read_configurations},
};

use super::{
    check_text::{basics, text},
    tolerance::ToleranceArgument,
};
use crate::{failure::Failure, print::Printer};

/// Whether a robot's table, its URDF and its physics twin are the same robot.
///
/// Compared at zero, one axis at a time, at 200 seeded random configurations within the limits,
/// at the limits, and at the worst configurations of the certificates. Exit code 1 if they disagree.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Folders with robot.toml, robot files, or bare .urdf files.
    #[arg(required = true)]
    robots: Vec<PathBuf>,
    /// Seed of the random configurations.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Compare at the configurations of this file as well and show the difference at each: a JSON array of
    /// {"q": {"joint": value}} in rad and m; joints that are not named are at 0.
    #[arg(long, value_name = "FILE")]
    configurations: Option<PathBuf>,
    /// Tolerance of positions and orientations in place of the robot file's, each with its unit: 1mm,0.1deg; a part
    /// that is not given stays the file's.
    #[arg(long, value_name = "LENGTH,ANGLE", allow_hyphen_values = true)]
    tolerance: Option<ToleranceArgument>,
    /// Also show the pose of the TCP at zero and its motion with each joint; JSON always has both.
    #[arg(long)]
    basics: bool,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let mut reports = Vec::with_capacity(arguments.robots.len());
    for path in &arguments.robots {
        let mut description = load_robot(path)?;
        printer.warnings(&description.warnings);
        let configurations = match &arguments.configurations {
            Some(path) => read_configurations(path, &description.robot)?,
            None => Vec::new(),
        };
        let declared = description.tolerance;
        if let Some(tolerance) = arguments.tolerance {
            description.tolerance = tolerance.replace(declared);
        }
        let mut report =
            congruent::check(&description, &CheckOptions { seed: arguments.seed, configurations })
                .map_err(|error| Diagnostic::error("check::robot", format!("{}: {error}", path.display())))?;
        report.replaced_tolerance = arguments.tolerance.map(|_| declared);
        reports.push(report);
    }
    let text = |report: &CheckReport| {
        let basics = if arguments.basics { basics(&report.basics) } else { String::new() };
        text(report) + &basics
    };
    let all_agree = reports.iter().all(|report| report.verdict == Agreement::Agree);
    match &reports[..] {
        [report] => printer.result(report, text)?,
        reports => printer.result(&reports, |reports| reports.iter().map(text).collect())?,
    }
    Ok(u8::from(!all_agree))
}
