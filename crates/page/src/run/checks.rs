//! The table of checks: the worst value of each quantity beside its limit, and how much of the limit it uses.

use congruent_input::display::quantity;
use congruent_monitors::verdict::{Bound, CheckResult, Measure, Moment, Status};
use congruent_results::report::{RunReport, is_not_reached, limit_words, margin_words, quantity_words};
use maud::{Markup, html};

use crate::parts::{BadgeKind, Pointer, badge, value};

/// Quantities of a check that are in the table; the report has all, as of every pair below a clearance.
const MOST_MEASURES: usize = 12;

/// The table, checks that failed first.
pub(super) fn checks(report: &RunReport) -> Markup {
    let index = |check: &CheckResult| {
        report.checks.iter().position(|other| std::ptr::eq(other, check)).unwrap_or_default()
    };
    html! {
        section {
            h2 { "Checks" }
            @if report.checks.is_empty() { p { "The scenario has no check." } }
            @else {
                table.checks {
                    thead { tr {
                        th { "check" } th { "result" } th { "worst value" } th { "limit" } th { "margin" } th { "where" } th { "when" }
                    } }
                    @for check in report.checks_failed_first() {
                        (rows(check, &Pointer::root().key("checks").key(index(check))))
                    }
                }
            }
        }
    }
}

fn rows(check: &CheckResult, at: &Pointer) -> Markup {
    let shown = check.measures.iter().take(MOST_MEASURES).enumerate();
    let further = check.measures.len().saturating_sub(MOST_MEASURES);
    html! {
        tbody {
            @if check.measures.is_empty() { tr { (name(check)) td colspan="5" { "no value" } } }
            @for (index, measure) in shown {
                tr {
                    @if index == 0 { (name(check)) } @else { td.again {} td.again {} }
                    (cells(measure, &at.key("measures").key(index)))
                }
            }
            @if further > 0 { tr { td.again {} td.again {} td colspan="5" { "and " (further) " more in the report" } } }
            // Those of a check that failed stand above the table.
            @if !check.notes.is_empty() && check.status != Status::Fail {
                tr.notes { td.again {} td colspan="6" { @for note in &check.notes { p { (note) } } } }
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

fn cells(measure: &Measure, at: &Pointer) -> Markup {
    let what = quantity_words(measure.quantity);
    let Some(worst) = &measure.worst else {
        return html! { td data-label="worst value" { (what) ": no value" } td data-label="limit" { (limit(measure, at)) } td {} td {} td {} };
    };
    let at_worst = at.key("worst");
    html! {
        td data-label="worst value" { (what) " " (value(&at_worst.key("value"), worst.value, &shown(measure, worst))) (bar(measure, worst.value)) }
        td data-label="limit" { (limit(measure, at)) }
        td data-label="margin" { (margin_words(measure, worst.value)) }
        td data-label="where" { (worst.subject) }
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
    value(&at.key("limit"), measure.limit, &limit_words(measure))
}

/// How much of its limit a value uses, as a bar: full at the limit.
fn bar(measure: &Measure, worst: f64) -> Markup {
    let share = match measure.bound {
        _ if measure.limit <= 0.0 || !worst.is_finite() => return html! {},
        // A joint inside its range is not near a limit of zero, which has no shares.
        Bound::AtMost if worst < 0.0 => return html! {},
        Bound::AtMost => worst / measure.limit,
        Bound::AtLeast | Bound::Above if worst <= 0.0 => 1.0,
        Bound::AtLeast | Bound::Above => measure.limit / worst,
    };
    let holds = measure.bound.holds(worst, measure.limit);
    let percent = if holds { (100.0 * share).clamp(0.0, 100.0) } else { 100.0 };
    html! {
        div.bar.(if holds { "good" } else { "bad" }) role="img" aria-label=(format!("{percent:.0} % of the limit")) {
            div style=(format!("width:{percent:.1}%")) {}
        }
    }
}
