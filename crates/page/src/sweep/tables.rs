//! The tables of a sweep's page: which value matters, the worst cases, those that could not be run.

use congruent_input::display::number;
use congruent_results::report::KeyImportance;
use congruent_sweep::summary::{SmallestMargin, SweepSummary};
use maud::{Markup, html};

use super::class;
use crate::parts::{Pointer, count, value};

/// Which key decides which quantity.
pub(super) fn importance(summary: &SweepSummary) -> Markup {
    let measures = Pointer::root().key("measures");
    html! {
        @if !summary.measures.is_empty() {
            section {
                h2 { "Which value matters" }
                p.small {
                    "Share of the variance of a quantity that follows from one key alone, with its interval of 95 % confidence; the arrow says whether more \
                     makes the quantity larger. What is missing to 100 % follows from keys together, or from the seed."
                }
                table.numbers {
                    thead { tr { th { "quantity" } th { "least" } th { "median" } th { "largest" } th { "outside" } th { "key: share of the variance" } } }
                    tbody {
                        @for (at, measure) in summary.measures.iter().enumerate() {
                            @let place = measures.key(at);
                            tr {
                                td { (measure.name) }
                                @for (entry, exact) in measure.range.into_iter().enumerate() {
                                    td { (value(&place.key("range").key(entry), exact, &number(exact))) }
                                }
                                td { (count(&place.key("outside"), measure.outside)) }
                                td { (shares(&measure.importance)) }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// The keys that decide something, the first of them if none clearly does.
fn shares(importance: &[KeyImportance]) -> Markup {
    let shown = importance.iter().enumerate().filter(|(at, key)| *at == 0 || key.interval[0] > 0.0);
    let percent = |share: f64| format!("{:.0}", 100.0 * share);
    html! {
        @if importance.is_empty() { "too few cases" }
        @for (at, key) in shown {
            @if at > 0 { ", " }
            code { (key.key) } " " (percent(key.share)) " % (" (percent(key.interval[0])) " to " (percent(key.interval[1])) ") "
            @if key.rank_correlation > 0.3 { "\u{2197}" } @else if key.rank_correlation < -0.3 { "\u{2198}" }
        }
    }
}

/// A number with the digits that people read; a word as it is.
fn short(value: &str) -> String {
    value.parse().map_or_else(|_| value.to_owned(), number)
}

/// The worst cases, each with its page.
pub(super) fn worst(summary: &SweepSummary) -> Markup {
    let row = |worst: &SmallestMargin, place: &Pointer| {
        html! {
            tr {
                td { @if let Some(page) = &worst.page { a href=(page) { "case " (worst.case) } } @else { "case " (worst.case) } }
                td.(class(worst.verdict)) { (worst.verdict.word().replace('_', " ")) }
                td { (worst.quantity) }
                td { @if let Some(exact) = worst.value { (value(&place.key("value"), exact, &number(exact))) } }
                td { (value(&place.key("limit"), worst.limit, &number(worst.limit))) }
                td { (value(&place.key("margin_share"), worst.margin_share, &number(100.0 * worst.margin_share))) }
                @for value in &worst.values { td { (short(value)) } }
                td { (worst.cause.as_deref().unwrap_or_default()) }
            }
        }
    };
    html! {
        @if !summary.worst.is_empty() {
            section {
                h2 { "The worst cases" }
                p.small { "With the smallest margin of all checks, as a share of the limit. Each was run again, with page and recording." }
                table.numbers {
                    thead { tr {
                        th { "case" } th { "verdict" } th { "quantity" } th { "value" } th { "limit" } th { "margin, %" }
                        @for key in &summary.header.keys { th { code { (key) } } }
                        th { "cause" }
                    } }
                    tbody {
                        @for (at, worst) in summary.worst.iter().enumerate() { (row(worst, &Pointer::root().key("worst").key(at))) }
                    }
                }
            }
        }
    }
}

/// The first cases without a result.
pub(super) fn refused(summary: &SweepSummary) -> Markup {
    html! {
        @if !summary.refused.is_empty() {
            section {
                h2 { "Cases without a result" }
                ul { @for (case, error) in &summary.refused { li { "case " (case) ": " (error) } } }
            }
        }
    }
}
