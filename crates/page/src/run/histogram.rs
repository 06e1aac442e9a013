//! How the values of all cases are distributed, as a small picture with the limit marked.

use congruent_results::report::QuantityInCases;
use maud::{Markup, html};

/// Size of the picture, px.
const SIZE: [f64; 2] = [160.0, 30.0];
/// Most widths of the values that the limit may be away from them, and still be in the picture. Kind: choice.
const FARTHEST_LIMIT: f64 = 2.0;

/// The picture of a quantity; nothing if all cases have one value.
pub(super) fn histogram(of: &QuantityInCases) -> Markup {
    let Some(histogram) = &of.histogram else { return html! {} };
    let [least, most] = histogram.range;
    let far = FARTHEST_LIMIT * (most - least);
    let has_limit = (least - far..=most + far).contains(&of.limit);
    let [from, to] = if has_limit { [least.min(of.limit), most.max(of.limit)] } else { [least, most] };
    let x = |value: f64| SIZE[0] * (value - from) / (to - from);
    let tallest = histogram.counts.iter().copied().max().unwrap_or(1).max(1);
    #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 cases")]
    let (part, height) = ((most - least) / histogram.counts.len() as f64, |count: u64| {
        SIZE[1] * count as f64 / tallest as f64
    });
    #[expect(clippy::cast_precision_loss, reason = "a few parts")]
    let start = |at: usize| least + part * at as f64;
    let within = |at: usize| of.bound.holds(start(at) + 0.5 * part, of.limit);
    html! {
        svg.histogram viewBox=(format!("0 -2 {} {}", SIZE[0], SIZE[1] + 2.0)) role="img" aria-label="distribution of the values" {
            @for (at, &count) in histogram.counts.iter().enumerate().filter(|(_, count)| **count > 0) {
                rect.(if within(at) { "good" } else { "bad" })
                    x=(format!("{:.2}", x(start(at)))) width=(format!("{:.2}", x(from + part).max(0.5)))
                    y=(format!("{:.2}", SIZE[1] - height(count))) height=(format!("{:.2}", height(count))) {}
            }
            @if has_limit {
                line x1=(format!("{:.2}", x(of.limit))) x2=(format!("{:.2}", x(of.limit))) y1="-2" y2=(SIZE[1]) {}
            }
        }
    }
}
