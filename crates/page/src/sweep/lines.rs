//! All cases as lines through parallel axes: one for each key, the last for the smallest margin.

use congruent_sweep::{run::CaseRow, store::MergedTable, summary::SweepSummary};
use maud::{Markup, html};

use super::{axis::PictureAxis, class};

const WIDTH: f64 = 980.0;
const HEIGHT: f64 = 260.0;
const MARGIN: f64 = 46.0;
/// Most lines; of more cases every so many is drawn, and all of the worst.
const MOST_LINES: usize = 1000;

/// The picture, if there is more than one axis.
pub(super) fn parallel(summary: &SweepSummary, table: &MergedTable) -> Markup {
    let worst = |row: &CaseRow| summary.worst.iter().any(|worst| worst.case == row.case);
    let every = table.rows.len().div_ceil(MOST_LINES).max(1);
    let drawn = table.rows.iter().enumerate().filter(|(at, row)| at % every == 0 || worst(row));
    let rows: Vec<(&CaseRow, f64)> =
        drawn.filter_map(|(_, row)| Some((row, row.least_margin()?.1))).collect();
    if rows.is_empty() {
        return Markup::default();
    }
    let axes: Vec<PictureAxis> = (0..table.header.keys.len())
        .map(|key| PictureAxis::of_written(rows.iter().map(|(row, _)| row.values[key].as_str())))
        .collect();
    let margins = PictureAxis::of_numbers(rows.iter().map(|(_, margin)| *margin));
    #[expect(clippy::cast_precision_loss, reason = "a few keys")]
    let x = |at: usize| MARGIN + at as f64 / axes.len() as f64 * (WIDTH - 2.0 * MARGIN);
    let y = |share: f64| HEIGHT - MARGIN - share * (HEIGHT - 2.0 * MARGIN);
    let path = |row: &CaseRow, margin: f64| {
        let keys = axes.iter().zip(&row.values).enumerate();
        let points = keys.map(|(at, (axis, value))| (x(at), y(axis.share_of_written(value).unwrap_or(0.5))));
        let all = points.chain([(x(axes.len()), y(margins.share(margin)))]);
        all.map(|(x, y)| format!("{x:.1},{y:.1}")).collect::<Vec<_>>().join(" ")
    };
    // The names at both ends would be cut off.
    let anchor = |at: usize| match at {
        0 => "start",
        at if at == axes.len() => "end",
        _ => "middle",
    };
    let names = table.header.keys.iter().map(String::as_str).chain(["smallest margin, share of the limit"]);
    let ends = axes.iter().chain([&margins]).map(PictureAxis::ends);
    html! {
        section {
            h2 { "Cases over all keys" }
            p.small { "A line is a case, from key to key, and ends at its smallest margin." }
            svg.sweep viewBox={ "0 0 " (WIDTH) " " (HEIGHT) } width=(WIDTH) height=(HEIGHT) role="img" {
                title { "parallel coordinates of " (rows.len()) " cases" }
                @for (row, margin) in &rows {
                    polyline.(class(row.verdict)) points=(path(row, *margin)) { title { "case " (row.case) } }
                }
                @for (at, (name, [low, high])) in names.zip(ends).enumerate() {
                    line.axis x1=(x(at)) x2=(x(at)) y1=(y(0.0)) y2=(y(1.0)) {}
                    text.axis.(anchor(at)) x=(x(at)) y=(y(0.0) + 14.0) { (low) }
                    text.axis.(anchor(at)) x=(x(at)) y=(y(1.0) - 6.0) { (high) }
                    text.axis.(anchor(at)) x=(x(at)) y=(if at % 2 == 0 { HEIGHT - 8.0 } else { 14.0 }) { (name) }
                }
            }
        }
    }
}
