//! The errors of `congruent check` at requested configurations: as lines, and as a table with the tip by both models.

use std::iter::{from_fn, once};

use congruent_text::{TextOptions, layout::Table};

use crate::{
    agreement::{
        SourcePair,
        compare::{CheckReport, DifferencesAt, TipDifference},
    },
    input::display::{angle, in_column, length, length_and_angle},
};

/// A text in parts of whole lines.
type DifferenceLines<'a> = Box<dyn Iterator<Item = String> + 'a>;

/// A line for each configuration: the worst of all comparisons.
pub(super) fn lines(differences: &DifferencesAt) -> DifferenceLines<'_> {
    Box::new((1..).zip(differences.iter()).map(|(at, difference)| {
        let error = length_and_angle(difference.error.position_m, difference.error.orientation_rad);
        format!("  at configuration {at}: {error}\n")
    }))
}

/// Rows in the memory at a time: columns are as wide as the widest entry among them. Kind: choice.
const ROWS: usize = 1000;

/// A table for each pair of models: the position of the tip by both, and the error.
pub(super) fn table<'a>(
    report: &'a CheckReport,
    differences: &'a DifferencesAt,
    options: &'a TextOptions,
) -> DifferenceLines<'a> {
    Box::new(shown_pairs(differences).into_iter().flat_map(move |pair| {
        let (first, second) = report.title(pair).split_once(" against ").unwrap_or_default();
        let title = format!(
            "  tip {} in {}: x, y, z in mm by {first}, by {second}, error\n",
            report.chain.tip, report.chain.base
        );
        let mut tips = (1..).zip(tip_differences(differences, pair)).peekable();
        once(title).chain(from_fn(move || {
            tips.peek()?;
            Some(rows(tips.by_ref().take(ROWS), options))
        }))
    }))
}

fn rows(tips: impl Iterator<Item = (usize, TipDifference)>, options: &TextOptions) -> String {
    let mut rows = Table::headed(["", "x", "y", "z", "x", "y", "z", "error", "angle"]);
    for (at, tip) in tips {
        let positions = [&tip.first, &tip.second].map(|pose| pose.translation_m);
        let positions = positions.into_iter().flatten().map(|value| in_column(value, "m"));
        let error = length(tip.error.position_m);
        let turn = angle(tip.error.orientation_rad);
        rows.row([at.to_string()].into_iter().chain(positions).chain([error, turn]));
    }
    let mut text = String::new();
    rows.write(&mut text, options.columns);
    text
}

/// The pairs of models that are shown: those of two descriptions, or URDF and physics if there is one alone.
pub fn shown_pairs(differences: &DifferencesAt) -> Vec<SourcePair> {
    // All configurations compare the same pairs.
    let first = differences.iter().next();
    let all: Vec<SourcePair> =
        first.map_or_else(Vec::new, |first| first.tip.iter().map(|tip| tip.pair).collect());
    let descriptions: Vec<SourcePair> =
        all.iter().copied().filter(|&pair| pair != SourcePair::UrdfSimulation).collect();
    if descriptions.is_empty() { all } else { descriptions }
}

/// The poses of the tip by both models of a pair, and their difference, at each configuration that has them.
pub fn tip_differences(
    differences: &DifferencesAt,
    pair: SourcePair,
) -> impl Iterator<Item = TipDifference> + '_ {
    differences.iter().filter_map(move |difference| difference.tip.into_iter().find(|tip| tip.pair == pair))
}
