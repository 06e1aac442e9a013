//! `congruent clearance`: distances between links.

use std::fmt::Write;

use congruent::{
    description::{Diagnostic, Use},
    twin::proximity::{DistanceReport, Overlap, PairChoice, distances},
};

use crate::{
    failure::Failure,
    input::{ConfigurationArguments, RobotArgument},
    print::Printer,
};

/// Distances between the convex hulls of links.
///
/// Pairs on the same or on neighbouring moving bodies and pairs that an SRDF disables are left out.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    #[command(flatten)]
    configurations: ConfigurationArguments,
    /// Give overlaps as negative depths instead of 0.
    #[arg(long)]
    penetration: bool,
    /// Leave out only pairs that cannot move against each other.
    #[arg(long)]
    all_pairs: bool,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let mut description = arguments.robot.load_for(Use::Clearance, printer)?;
    let configurations = arguments.configurations.read(&mut description, printer)?;
    let choice = if arguments.all_pairs { PairChoice::All } else { PairChoice::Usual };
    let overlap = if arguments.penetration { Overlap::Depth } else { Overlap::Zero };
    let report = distances(&description, &[], (choice, overlap), &configurations)
        .map_err(|error| Diagnostic::error("clearance::shape", error.to_string()))?;
    printer.result(&report, text)?;
    Ok(0)
}

fn text(report: &DistanceReport) -> String {
    if report.pairs.is_empty() {
        return "no pair of links to measure; --all-pairs adds neighbours\n".to_owned();
    }
    let mut text = String::new();
    for (index, result) in report.results.iter().enumerate() {
        let _ = writeln!(text, "configuration {}: nearest pairs first", index + 1);
        let mut order: Vec<usize> = (0..report.pairs.len()).collect();
        order.sort_by(|&a, &b| result.distances_m[a].total_cmp(&result.distances_m[b]));
        for pair in order {
            let [a, b] = &report.pairs[pair];
            let _ = writeln!(text, "  {:12.9} m  {a} -- {b}", result.distances_m[pair]);
        }
    }
    text
}
