//! The table of checks: the worst value of each quantity beside its limit, and how much of the limit it uses.

use congruent_input::{
    Quantity,
    display::{counted, quantity},
};
use congruent_monitors::verdict::{Bound, CheckResult, Measure, Moment, Status};
use congruent_results::report::{
    RunReport, is_not_reached, joint_limit_words, limit_words, margin_words, not_finite_words, quantity_words,
};
use maud::{Markup, html};

use super::content::RunContent;
use crate::parts::{BadgeKind, BarScale, Pointer, UsedShare, badge, value};

/// Quantities of a check that are in the table; the report has all, as of every pair below a clearance.
const MOST_MEASURES: usize = 12;

/// Which run the tables are of, if there are cases with other values.
const NOMINAL: &str = " with nominal values";

/// The tables: of the checks that failed, and of the others, which are folded if any failed.
pub(super) fn checks(report: &RunReport, run: &RunContent) -> Markup {
    let (failed, others): (Vec<_>, Vec<_>) = report
        .checks_failed_first()
        .into_iter()
        .partition(|check| matches!(check.status, Status::Fail | Status::Error));
    let passed = others.iter().filter(|check| check.status == Status::Pass).count();
    let scale =
        BarScale::for_shares(report.checks.iter().flat_map(|check| &check.measures).filter_map(share));
    let table = |checks: &[&CheckResult]| table(checks, &CheckRows { report, run, scale });
    html! {
        section {
            @if report.checks.is_empty() { h2 { "Checks" } p { "The scenario has no check." } }
            @else if failed.is_empty() {
                h2 { "What was checked" @if report.uncertainty.is_some() { (NOMINAL) } }
                (table(&others))
                (BarScale::words())
            } @else {
                h2 { "The checks that failed" @if report.uncertainty.is_some() { (NOMINAL) } }
                (table(&failed))
                (BarScale::words())
                @if !others.is_empty() {
                    details {
                        summary { "what passed (" (counted(passed, "check")) ")" @if passed < others.len() { ", and what says nothing (" (others.len() - passed) ")" } }
                        (table(&others))
                    }
                }
            }
        }
    }
}

/// What the rows of a table need.
struct CheckRows<'a> {
    report: &'a RunReport,
    run: &'a RunContent,
    scale: BarScale,
}

fn table(checks: &[&CheckResult], of: &CheckRows<'_>) -> Markup {
    let index = |check: &CheckResult| {
        of.report.checks.iter().position(|other| std::ptr::eq(other, check)).unwrap_or_default()
    };
    html! {
        table.checks {
            thead { tr {
                th { "check" } th { "result" } th { "worst value" } th { "of its limit" } th { "limit" } th { "margin" } th { "where" } th { "when" }
            } }
            @for check in checks {
                (rows(check, of, &Pointer::root().key("checks").key(index(check))))
            }
        }
    }
}

fn rows(check: &CheckResult, of: &CheckRows<'_>, at: &Pointer) -> Markup {
    let shown = check.measures.iter().take(MOST_MEASURES).enumerate();
    let further = check.measures.len().saturating_sub(MOST_MEASURES);
    // Before the nearer pair that no motion of the run brings nearer.
    let first = check.nearest_that_changes.as_ref().zip(check.measures.first());
    let measures = at.key("measures");
    html! {
        tbody {
            @if check.measures.is_empty() { tr { (name(check)) td colspan="6" { "no value" } } }
            @if let Some((moment, measure)) = first {
                tr {
                    (name(check))
                    (cells(&ValueRow { measure, worst: Some(moment), at: measures.key(0), at_worst: at.key("nearest_that_changes") }, of))
                }
            }
            @for (index, measure) in shown {
                tr {
                    @if index == 0 && first.is_none() { (name(check)) } @else { td.again {} td.again {} }
                    (cells(&ValueRow { measure, worst: measure.worst.as_ref(), at: measures.key(index), at_worst: measures.key(index).key("worst") }, of))
                }
            }
            @if further > 0 { tr { td.again {} td.again {} td colspan="6" { "and " (further) " more in the report" } } }
            // Those of a check that failed stand above the table.
            @if !check.notes.is_empty() && check.status != Status::Fail {
                tr.notes { td.again {} td colspan="7" { @for note in &check.notes { p { (note) } } } }
            }
        }
    }
}

fn name(check: &CheckResult) -> Markup {
    let outcome = match check.status {
        Status::Pass => BadgeKind::Good,
        Status::Fail | Status::Error => BadgeKind::Bad,
        Status::Skipped | Status::Inconclusive => BadgeKind::Unclear,
    };
    html! {
        th scope="row" { (check.check) @if check.is_default { span.small { " (default)" } } @if let Some(line) = check.line { span.small { " line " (line) } } }
        td { (badge(outcome, check.status.word())) }
    }
}

/// A row: one value of a measure, and where report.json has both.
struct ValueRow<'a> {
    measure: &'a Measure,
    worst: Option<&'a Moment>,
    at: Pointer,
    at_worst: Pointer,
}

fn cells(row: &ValueRow<'_>, of: &CheckRows<'_>) -> Markup {
    let ValueRow { measure, worst, at, at_worst } = row;
    let mut what = quantity_words(measure.quantity);
    let Some(worst) = worst else {
        return html! { td data-label="worst value" { (what) ": no value" } td {} td data-label="limit" { (limit(measure, at)) } td {} td {} td {} };
    };
    let mut shown = shown(measure, worst);
    if is_of_joint_limit(measure) && worst.value < 0.0 {
        "distance to the joint limit".clone_into(&mut what);
        shown = quantity(-worst.value, measure.unit.symbol());
    }
    if measure.quantity == Quantity::NotFiniteValues && worst.value <= 0.0 {
        let words = not_finite_words(worst.value);
        return html! { td data-label="worst value" { (value(&at_worst.key("value"), worst.value, &words)) } td {} td {} td {} td {} td {} };
    }
    html! {
        td data-label="worst value" { (what) " " (value(&at_worst.key("value"), worst.value, &shown)) }
        td data-label="of its limit" { @if let Some(share) = share_of(measure, worst) { (of.scale.bar(UsedShare { share, holds: measure.bound.holds(worst.value, measure.limit) })) } }
        td data-label="limit" { (limit(measure, at)) }
        td data-label="margin" { (margin_words(measure, worst.value)) }
        td data-label="where" { (worst.subject) @if let Some(why) = why_constant(&worst.subject, of.run) { " " span.small { (why) } } }
        td data-label="when" {
            (value(&at_worst.key("time_s"), worst.time_s, &quantity(worst.time_s, "s")))
            @if let Some(first) = measure.first_violation.as_ref().filter(|first| first.time_s < worst.time_s) {
                ", first at "
                (value(&at.keys(&["first_violation", "time_s"]), first.time_s, &quantity(first.time_s, "s")))
            }
        }
    }
}

fn shown(measure: &Measure, moment: &Moment) -> String {
    if is_not_reached(moment.value, measure.unit) {
        "never".to_owned()
    } else {
        quantity(moment.value, measure.unit.symbol())
    }
}

fn limit(measure: &Measure, at: &Pointer) -> Markup {
    // The title of the column is the first word. A joint inside its range is reported by its distance to the limit, and so is
    // what is allowed.
    let is_inside = measure.worst.as_ref().is_some_and(|worst| worst.value < 0.0);
    let words = if is_of_joint_limit(measure) && is_inside {
        joint_limit_words(measure)
    } else {
        limit_words(measure)
    };
    value(&at.key("limit"), measure.limit, words.strip_prefix("limit ").unwrap_or(&words))
}

/// Whether a measure is about the range of a joint.
fn is_of_joint_limit(measure: &Measure) -> bool {
    matches!(measure.quantity, Quantity::AngleBeyondLimit | Quantity::ShiftBeyondLimit)
}

/// Why the distance that a value is about never changes; `None` if it does, or is none.
fn why_constant(subject: &str, run: &RunContent) -> Option<&'static str> {
    run.series.nearest.why_constant(run.names.pairs.iter().position(|pair| pair == subject)?)
}

/// How much of its limit the worst value uses; `None` if that says nothing.
fn share(measure: &Measure) -> Option<f64> {
    share_of(measure, measure.worst.as_ref()?)
}

fn share_of(measure: &Measure, worst: &Moment) -> Option<f64> {
    let worst = worst.value;
    match measure.bound {
        _ if measure.limit <= 0.0 || !worst.is_finite() => None,
        // A joint inside its range is not near a limit of zero, which has no shares.
        Bound::AtMost if worst < 0.0 => None,
        Bound::AtMost => Some(worst / measure.limit),
        Bound::AtLeast | Bound::Above if worst <= 0.0 => Some(f64::INFINITY),
        Bound::AtLeast | Bound::Above => Some(measure.limit / worst),
    }
}
