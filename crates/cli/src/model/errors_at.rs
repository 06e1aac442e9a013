//! The errors of `congruent check` at the configurations of `--configurations`: as lines, as a table with the tip by both
//! models, and as a chart.

use std::fmt::Write;

use congruent::{
    agreement::{
        SourcePair,
        compare::{CheckReport, TipDifference},
    },
    analysis::plot::{ErrorChart, ErrorPanel},
    description::display::{angle, in_column, length, length_and_angle},
};

use crate::table::Table;

/// A line for each configuration: the worst of all comparisons.
pub(super) fn lines(report: &CheckReport) -> String {
    let mut text = String::new();
    for (at, difference) in (1..).zip(&report.at_configurations) {
        let error = length_and_angle(difference.error.position_m, difference.error.orientation_rad);
        let _ = writeln!(text, "  at configuration {at}: {error}");
    }
    text
}

/// A table for each pair of models: the position of the tip by both, and the error.
pub(super) fn table(report: &CheckReport) -> String {
    let mut text = String::new();
    for pair in pairs(report) {
        let [first, second] = names(pair);
        let _ = writeln!(
            text,
            "  tip {} in {}: x, y, z in mm by {first}, by {second}, error",
            report.chain.tip, report.chain.base
        );
        let mut rows = Table::headed(["", "x", "y", "z", "x", "y", "z", "error", "angle"]);
        for (at, tip) in (1..).zip(of_pair(report, pair)) {
            let positions = [&tip.first, &tip.second].map(|pose| pose.translation_m);
            let positions = positions.into_iter().flatten().map(|value| in_column(value, "m"));
            let error = length(tip.error.position_m);
            let turn = angle(tip.error.orientation_rad);
            rows.row([at.to_string()].into_iter().chain(positions).chain([error, turn]));
        }
        rows.write(&mut text);
    }
    text
}

/// The errors of the tip, a series for each pair of models.
pub(super) fn chart(report: &CheckReport) -> ErrorChart {
    let pairs = pairs(report);
    let values = |of: fn(&TipDifference) -> f64| -> Vec<Vec<f64>> {
        pairs.iter().map(|&pair| of_pair(report, pair).map(of).collect()).collect()
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
fn pairs(report: &CheckReport) -> Vec<SourcePair> {
    let all: Vec<SourcePair> = report
        .at_configurations
        .first()
        .map_or_else(Vec::new, |first| first.tip.iter().map(|tip| tip.pair).collect());
    let descriptions: Vec<SourcePair> =
        all.iter().copied().filter(|&pair| pair != SourcePair::UrdfSimulation).collect();
    if descriptions.is_empty() { all } else { descriptions }
}

fn of_pair(report: &CheckReport, pair: SourcePair) -> impl Iterator<Item = &TipDifference> {
    let tips = report.at_configurations.iter();
    tips.filter_map(move |difference| difference.tip.iter().find(|tip| tip.pair == pair))
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
