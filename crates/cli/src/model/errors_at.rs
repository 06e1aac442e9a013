//! The errors of `congruent check` at the configurations of `--configurations`: as lines, as a table with the tip by both
//! models, and as a chart.

use std::iter::{from_fn, once};

use congruent::{
    agreement::{
        SourcePair,
        compare::{CheckReport, DifferencesAt, TipDifference},
    },
    analysis::plot::{ErrorChart, ErrorPanel},
    description::display::{angle, in_column, length, length_and_angle},
};

use crate::{batch::Parts, terminal::table::Table};

/// A line for each configuration: the worst of all comparisons.
pub(super) fn lines(differences: &DifferencesAt) -> Parts<'_> {
    Box::new((1..).zip(differences.iter()).map(|(at, difference)| {
        let error = length_and_angle(difference.error.position_m, difference.error.orientation_rad);
        format!("  at configuration {at}: {error}\n")
    }))
}

/// Rows in the memory at a time: the width of a column is that of so many. Kind: choice.
const ROWS: usize = 1000;

/// A table for each pair of models: the position of the tip by both, and the error.
pub(super) fn table<'a>(report: &'a CheckReport, differences: &'a DifferencesAt) -> Parts<'a> {
    Box::new(pairs(differences).into_iter().flat_map(move |pair| {
        let [first, second] = names(pair);
        let title = format!(
            "  tip {} in {}: x, y, z in mm by {first}, by {second}, error\n",
            report.chain.tip, report.chain.base
        );
        let mut tips = (1..).zip(of_pair(differences, pair)).peekable();
        once(title).chain(from_fn(move || {
            tips.peek()?;
            Some(rows(tips.by_ref().take(ROWS)))
        }))
    }))
}

fn rows(tips: impl Iterator<Item = (usize, TipDifference)>) -> String {
    let mut rows = Table::headed(["", "x", "y", "z", "x", "y", "z", "error", "angle"]);
    for (at, tip) in tips {
        let positions = [&tip.first, &tip.second].map(|pose| pose.translation_m);
        let positions = positions.into_iter().flatten().map(|value| in_column(value, "m"));
        let error = length(tip.error.position_m);
        let turn = angle(tip.error.orientation_rad);
        rows.row([at.to_string()].into_iter().chain(positions).chain([error, turn]));
    }
    let mut text = String::new();
    rows.write(&mut text);
    text
}

/// The errors of the tip, a series for each pair of models.
pub(super) fn chart(report: &CheckReport, differences: &DifferencesAt) -> ErrorChart {
    let pairs = pairs(differences);
    let values = |of: fn(&TipDifference) -> f64| -> Vec<Vec<f64>> {
        pairs.iter().map(|&pair| of_pair(differences, pair).map(|tip| of(&tip)).collect()).collect()
    };
    let panel = |name: &str, unit: &str, tolerance, values| ErrorPanel {
        name: name.to_owned(),
        unit: unit.to_owned(),
        values,
        tolerance,
    };
    let position = values(|tip| tip.error.position_m * 1e3);
    let orientation = values(|tip| tip.error.orientation_rad.to_degrees());
    ErrorChart {
        title: format!("{}: error of {} at each configuration", report.robot, report.chain.tip),
        series: pairs.iter().map(|pair| pair.title().to_owned()).collect(),
        panels: vec![
            panel("position", "mm", report.tolerance.position_m * 1e3, position),
            panel("orientation", "deg", report.tolerance.orientation_rad.to_degrees(), orientation),
        ],
    }
}

/// The pairs that are shown: those of two descriptions, or URDF and physics if there is one alone.
fn pairs(differences: &DifferencesAt) -> Vec<SourcePair> {
    let first = differences.iter().next();
    let all: Vec<SourcePair> =
        first.map_or_else(Vec::new, |first| first.tip.iter().map(|tip| tip.pair).collect());
    let descriptions: Vec<SourcePair> =
        all.iter().copied().filter(|&pair| pair != SourcePair::UrdfSimulation).collect();
    if descriptions.is_empty() { all } else { descriptions }
}

fn of_pair(differences: &DifferencesAt, pair: SourcePair) -> impl Iterator<Item = TipDifference> + '_ {
    differences.iter().filter_map(move |difference| difference.tip.into_iter().find(|tip| tip.pair == pair))
}

fn names(pair: SourcePair) -> [&'static str; 2] {
    match pair {
        SourcePair::ModelUrdf => ["table", "URDF"],
        SourcePair::PoeUrdf => ["screws", "URDF"],
        SourcePair::ModelSimulation => ["table", "physics"],
        SourcePair::UrdfSimulation => ["URDF", "physics"],
        SourcePair::UrdfOther => ["URDF", "the other URDF"],
    }
}
