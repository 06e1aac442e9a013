//! `congruent clearance`: distances between links.

use congruent::{
    input::{Capability, Diagnostic},
    proximity::{DistanceError, DistanceOptions, Overlap, PairChoice, PairNames, distances},
    text::clearance_text_parts,
};

use super::disabled_pairs::DisabledPairsArguments;
use crate::{
    codes,
    configurations::ConfigurationArguments,
    failure::{FAILED, Failure, NOTHING},
    input::{RobotArguments, SetRobotArgument},
    quantity::length_with_unit,
    terminal::print::{Printer, text_options},
};

/// Distances between the convex hulls of links.
///
/// Pairs on the same or on neighbouring moving bodies and pairs that an SRDF disables are left out. --write-srdf proposes
/// such an SRDF.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: SetRobotArgument,
    #[command(flatten)]
    configurations: ConfigurationArguments,
    /// Give overlaps as negative depths instead of 0.
    #[arg(long)]
    penetration: bool,
    /// Leave out only pairs that cannot move relative to each other.
    #[arg(long)]
    all_pairs: bool,
    /// Measure only this pair of links; may be given several times. `*` stands for any characters.
    #[arg(long, value_name = "A,B", value_parser = pair)]
    pair: Vec<[String; 2]>,
    /// Leave out this pair of links; may be given several times. `*` stands for any characters.
    #[arg(long, value_name = "A,B", value_parser = pair)]
    ignore: Vec<[String; 2]>,
    /// Smallest distance that is allowed, with its unit: 20mm; exit code 1 if a pair is nearer.
    #[arg(long, value_name = "LENGTH", value_parser = length_with_unit, allow_hyphen_values = true)]
    limit: Option<f64>,
    #[command(flatten)]
    disabled_pairs: DisabledPairsArguments,
}

fn pair(text: &str) -> Result<[String; 2], String> {
    match text.split(',').map(str::trim).collect::<Vec<_>>()[..] {
        [a, b] if !a.is_empty() && !b.is_empty() => Ok([a.to_owned(), b.to_owned()]),
        _ => Err("expected the names of two links, as in wrist_1_link,wrist_3_link".to_owned()),
    }
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let mut description = arguments.robot.load_for(Capability::Clearance, printer)?;
    if let Some(file) = arguments.disabled_pairs.file() {
        return arguments.disabled_pairs.write(file, &description, printer);
    }
    let configurations = arguments.configurations.read(&mut description, printer)?;
    let options = DistanceOptions {
        choice: if arguments.all_pairs { PairChoice::All } else { PairChoice::Usual },
        names: PairNames { pairs: arguments.pair.clone(), ignore: arguments.ignore.clone() },
        overlap: if arguments.penetration { Overlap::Depth } else { Overlap::Zero },
        limit_m: arguments.limit,
    };
    let report = distances(&description, &[], &options, &configurations).map_err(|error| match error {
        DistanceError::Pair(fault) => fault.diagnostic,
        error => Diagnostic::error(codes::clearance::SHAPE, error.to_string()),
    })?;
    // Those of the description were printed when it was loaded.
    printer.warnings(None, &report.hull_warnings);
    let options = text_options();
    printer.parts(&report, |report| clearance_text_parts(report, &description.robot, &options))?;
    let is_nothing = report.pairs.is_empty() || report.results.is_empty();
    let has_failed = !report.below.is_empty();
    Ok(if is_nothing { NOTHING } else { u8::from(has_failed) * FAILED })
}
