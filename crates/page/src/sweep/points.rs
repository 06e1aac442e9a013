//! All cases as points: the worst value of a check over the value that decides it most.

use congruent_sweep::{run::CaseRow, store::MergedTable, summary::SweepSummary};
use maud::{Markup, html};

use super::{axis::PictureAxis, class};

/// Size of a picture, and the space of its axes, in points.
const WIDTH: f64 = 360.0;
const HEIGHT: f64 = 240.0;
const MARGIN: f64 = 56.0;
/// Most quantities that have a picture.
const MOST_QUANTITIES: usize = 6;
/// Most points of a picture; of more cases every so many is drawn.
const MOST_POINTS: usize = 4000;

/// One picture for each quantity, those with the smallest margin first.
pub(super) fn scatter(summary: &SweepSummary, table: &MergedTable) -> Markup {
    let quantities = summary.measures.iter().take(MOST_QUANTITIES);
    html! {
        @if !summary.measures.is_empty() {
            section {
                h2 { "Cases" }
                p.small {
                    "A point is a case: green passes, red fails. Below each picture is the key that decides its quantity most; the line is the limit."
                }
                div.pictures {
                    @for measure in quantities {
                        @let key = measure.importance.first().map(|of| of.key.as_str());
                        @let at = key.and_then(|key| table.header.keys.iter().position(|each| each == key)).unwrap_or(0);
                        (picture(&measure.name, at, table))
                    }
                }
            }
        }
    }
}

fn picture(quantity: &str, key: usize, table: &MergedTable) -> Markup {
    let every = table.rows.len().div_ceil(MOST_POINTS).max(1);
    let rows: Vec<&CaseRow> =
        table.rows.iter().step_by(every).filter(|row| row.worst.contains_key(quantity)).collect();
    let value = |row: &CaseRow| row.worst.get(quantity).and_then(|worst| worst.value);
    let limits = rows.iter().filter_map(|row| row.worst.get(quantity)).map(|worst| worst.limit);
    let limit = PictureAxis::of_numbers(limits.clone());
    let across = PictureAxis::of_written(rows.iter().map(|row| row.values[key].as_str()));
    let upward = PictureAxis::of_numbers(rows.iter().filter_map(|row| value(row)).chain(limits.clone()));
    let (x, y) = (
        |share: f64| MARGIN + share * (WIDTH - 1.3 * MARGIN),
        |share: f64| HEIGHT - MARGIN - share * (HEIGHT - 1.5 * MARGIN),
    );
    let [left, right] = across.ends();
    let [bottom, top] = upward.ends();
    // One line, if no case has another limit.
    let line = limits
        .clone()
        .next()
        .filter(|_| limit.ends()[0] == limit.ends()[1])
        .map(|limit| y(upward.share(limit)));
    html! {
        svg.sweep viewBox={ "0 0 " (WIDTH) " " (HEIGHT) } width=(WIDTH) height=(HEIGHT) role="img" {
            title { (quantity) " over " (table.header.keys[key]) }
            text x=(MARGIN) y="14" { (quantity) }
            text.axis x=(x(0.0)) y=(HEIGHT - MARGIN + 14.0) { (left) }
            text.axis.end x=(x(1.0)) y=(HEIGHT - MARGIN + 14.0) { (right) }
            text.axis x=(MARGIN) y=(HEIGHT - 10.0) { (table.header.keys[key]) }
            text.axis.end x=(MARGIN - 4.0) y=(y(0.0)) { (bottom) }
            text.axis.end x=(MARGIN - 4.0) y=(y(1.0) + 8.0) { (top) }
            @if let Some(line) = line { line.limit x1=(x(0.0)) x2=(x(1.0)) y1=(line) y2=(line) {} }
            @for row in &rows {
                @if let (Some(at), Some(value)) = (across.share_of_written(&row.values[key]), value(row)) {
                    circle.(class(row.verdict)) cx=(format!("{:.1}", x(at))) cy=(format!("{:.1}", y(upward.share(value)))) r="2.4" {
                        title { "case " (row.case) }
                    }
                }
            }
        }
    }
}
