//! What `congruent clearance` prints.

use std::{fmt::Write, iter::once};

use congruent_description::Robot;
use congruent_input::display::{in_column, length};
use congruent_proximity::{DistanceReport, Distances};

use crate::{TextOptions, layout::Table};

/// What `congruent clearance` prints: ignored pairs and pairs below the limit, then the distances at each configuration, in
/// parts of whole lines.
pub fn clearance_text_parts<'a>(
    report: &'a DistanceReport<'_>,
    robot: &Robot,
    options: &'a TextOptions,
) -> impl Iterator<Item = String> + 'a {
    // Without a pair there is nothing to say of a configuration.
    let shown = if report.pairs.is_empty() { 0 } else { usize::MAX };
    let configurations = (1..).zip(report.results.iter()).take(shown);
    once(summary(report, robot, options))
        .chain(configurations.map(move |(number, result)| nearest(report, number, &result, options)))
}

fn summary(report: &DistanceReport<'_>, robot: &Robot, options: &TextOptions) -> String {
    let mut text = format!("{}: distances between links, the nearest pair first\n", report.robot);
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
        below(&mut text, report, limit_m, options);
    }
    text
}

/// The distances at one configuration, the nearest pair first.
fn nearest(report: &DistanceReport<'_>, number: usize, result: &Distances, options: &TextOptions) -> String {
    let mut text = format!("configuration {number}\n");
    let mut order: Vec<usize> = (0..report.pairs.len()).collect();
    order.sort_by(|&a, &b| result.distances_m[a].total_cmp(&result.distances_m[b]));
    let mut table = Table::headed(["", "mm"]);
    for pair in order {
        let [a, b] = &report.pairs[pair];
        table.row([format!("{a} -- {b}"), in_column(result.distances_m[pair], "m")]);
    }
    table.write(&mut text, options.columns);
    text
}

fn below(text: &mut String, report: &DistanceReport<'_>, limit_m: f64, options: &TextOptions) {
    if report.below.is_empty() {
        let least_m = report.least_m.unwrap_or(f64::INFINITY);
        let [least, limit, margin] = [least_m, limit_m, least_m - limit_m].map(length);
        let _ = writeln!(text, "no pair is below the limit: {least}, limit >= {limit}, margin {margin}");
        return;
    }
    let all = report.pairs.len();
    let _ =
        writeln!(text, "{} of {all} pairs are below the limit of {}", report.below.len(), length(limit_m));
    let mut table = Table::headed(["", "smallest mm", "below the limit mm", "configuration"]);
    for found in &report.below {
        let [a, b] = &found.pair;
        let values = [found.distance_m, limit_m - found.distance_m].map(|value| in_column(value, "m"));
        let named = [format!("{a} -- {b}")].into_iter().chain(values);
        table.row(named.chain([found.configuration.to_string()]));
    }
    table.write(text, options.columns);
}
