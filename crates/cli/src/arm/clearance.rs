//! `congruent clearance`: distances between links.

use std::{fmt::Write, iter::once};

use congruent::{
    description::Robot,
    input::{
        Capability, Diagnostic,
        display::{in_column, length},
    },
    proximity::{
        DistanceError, DistanceOptions, DistanceReport, Distances, Overlap, PairChoice, PairNames, distances,
    },
};

use super::length::positive_length;
use crate::{
    failure::{FAILED, Failure, NOTHING},
    input::{ConfigurationArguments, RobotArgument},
    terminal::{columns, layout::Table, print::Printer},
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
    /// Leave out only pairs that cannot move relative to each other.
    #[arg(long)]
    all_pairs: bool,
    /// Measure only this pair of links; may be given several times. `*` stands for any characters.
    #[arg(long, value_name = "A,B", value_parser = pair)]
    pair: Vec<[String; 2]>,
    /// Leave out this pair of links; may be given several times. `*` stands for any characters.
    #[arg(long, value_name = "A,B", value_parser = pair)]
    ignore: Vec<[String; 2]>,
    /// Smallest distance that is allowed; exit code 1 if a pair is nearer.
    #[arg(long, value_name = "LENGTH", value_parser = positive_length, allow_hyphen_values = true)]
    limit: Option<f64>,
}

fn pair(text: &str) -> Result<[String; 2], String> {
    match text.split(',').map(str::trim).collect::<Vec<_>>()[..] {
        [a, b] if !a.is_empty() && !b.is_empty() => Ok([a.to_owned(), b.to_owned()]),
        _ => Err("expected the names of two links, as in wrist_1_link,wrist_3_link".to_owned()),
    }
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let mut description = arguments.robot.load_for(Capability::Clearance, printer)?;
    let configurations = arguments.configurations.read(&mut description, printer)?;
    let options = DistanceOptions {
        choice: if arguments.all_pairs { PairChoice::All } else { PairChoice::Usual },
        names: PairNames { pairs: arguments.pair.clone(), ignore: arguments.ignore.clone() },
        overlap: if arguments.penetration { Overlap::Depth } else { Overlap::Zero },
        limit_m: arguments.limit,
    };
    let report = distances(&description, &[], &options, &configurations).map_err(|error| match error {
        DistanceError::Pair(fault) => fault.diagnostic,
        error => Diagnostic::error("clearance::shape", error.to_string()),
    })?;
    // Those of the description were printed when it was loaded.
    let of_hulls = report.warnings.iter().skip(description.warnings.len());
    let of_hulls = of_hulls.map(|found| {
        let warning = Diagnostic::warning(found.code, found.message.clone());
        warning.with_help(found.help.clone().unwrap_or_default())
    });
    printer.warnings(None, &of_hulls.collect::<Vec<_>>());
    printer.parts(&report, |report| parts(report, &description.robot))?;
    let is_nothing = report.pairs.is_empty() || report.results.is_empty();
    let has_failed = !report.below.is_empty();
    Ok(if is_nothing { NOTHING } else { u8::from(has_failed) * FAILED })
}

/// Ignored pairs and pairs below the limit, then the distances at each configuration.
fn parts<'a>(report: &'a DistanceReport<'_>, robot: &Robot) -> impl Iterator<Item = String> + 'a {
    // Without a pair there is nothing to say of a configuration.
    let shown = if report.pairs.is_empty() { 0 } else { usize::MAX };
    let configurations = (1..).zip(report.results.iter()).take(shown);
    once(summary(report, robot))
        .chain(configurations.map(|(number, result)| nearest(report, number, &result)))
}

fn summary(report: &DistanceReport<'_>, robot: &Robot) -> String {
    let mut text = String::new();
    for [a, b] in &report.ignored {
        let _ = writeln!(text, "ignored: {a} -- {b}");
    }
    if report.pairs.is_empty() {
        let has_shape = robot.links().iter().any(|link| !link.collisions.is_empty());
        text += match (has_shape, report.ignored.is_empty()) {
            (false, _) => "nothing to measure: no link has a <collision> shape\n",
            (true, false) => "no pair of links to measure: all are ignored\n",
            (true, true) => {
                "no pair of links to measure; --all-pairs adds neighbours and pairs that the SRDF disables\n"
            }
        };
        return text;
    }
    if let Some(limit_m) = report.limit_m {
        below(&mut text, report, limit_m);
    }
    text
}

/// The distances at one configuration, the nearest pair first.
fn nearest(report: &DistanceReport<'_>, number: usize, result: &Distances) -> String {
    let mut text = format!("configuration {number}: nearest pairs first\n");
    let mut order: Vec<usize> = (0..report.pairs.len()).collect();
    order.sort_by(|&a, &b| result.distances_m[a].total_cmp(&result.distances_m[b]));
    let mut table = Table::headed(["", "mm"]);
    for pair in order {
        let [a, b] = &report.pairs[pair];
        table.row([format!("{a} -- {b}"), in_column(result.distances_m[pair], "m")]);
    }
    table.write(&mut text, columns());
    text
}

fn below(text: &mut String, report: &DistanceReport<'_>, limit_m: f64) {
    if report.below.is_empty() {
        let least_m = report.least_m.unwrap_or(f64::INFINITY);
        let [least, limit, margin] = [least_m, limit_m, least_m - limit_m].map(length);
        let _ = writeln!(text, "no pair is below the limit: {least}, limit >= {limit}, margin {margin}");
        return;
    }
    let all = report.pairs.len();
    let _ =
        writeln!(text, "{} of {all} pairs are below the limit of {}", report.below.len(), length(limit_m));
    let mut table = Table::headed(["", "least mm", "below mm", "configuration"]);
    for found in &report.below {
        let [a, b] = &found.pair;
        let values = [found.distance_m, limit_m - found.distance_m].map(|value| in_column(value, "m"));
        let named = [format!("{a} -- {b}")].into_iter().chain(values);
        table.row(named.chain([found.configuration.to_string()]));
    }
    table.write(text, columns());
}
