//! The errors of `congruent check` at the configurations of `--configurations` as a chart.

use congruent::{
    agreement::compare::{CheckReport, DifferencesAt, TipDifference},
    analysis::plot::{ErrorChart, ErrorPanel},
    text::{shown_pairs, tip_differences},
};

/// The errors of the tip, a series for each pair of models.
pub(super) fn chart(report: &CheckReport, differences: &DifferencesAt) -> ErrorChart {
    let pairs = shown_pairs(differences);
    let values = |of: fn(&TipDifference) -> f64| -> Vec<Vec<f64>> {
        pairs.iter().map(|&pair| tip_differences(differences, pair).map(|tip| of(&tip)).collect()).collect()
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
        series: pairs.iter().map(|&pair| report.title(pair).to_owned()).collect(),
        panels: vec![
            panel("position", "mm", report.tolerance.position_m * 1e3, position),
            panel("orientation", "deg", report.tolerance.orientation_rad.to_degrees(), orientation),
        ],
    }
}
