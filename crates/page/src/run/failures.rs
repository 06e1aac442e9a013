//! What failed, at the top of the page: the quantity that was violated first over time, with its limit and that instant, beside
//! the robot at that instant; then all checks that failed, in sentences, with their plots.

use congruent_input::{
    Quantity, SiUnit,
    display::{number, quantity},
};
use congruent_monitors::verdict::{CheckResult, Measure, Status, Verdict};
use congruent_results::report::{RunReport, lines, quantity_words};
use congruent_scenario::CheckKind;
use maud::{Markup, html};

use super::{
    content::RunContent,
    curves::{axis, limit_of, of_check, tracking_id},
    figures::caption,
    scene::scene,
    violated::violated,
};
use crate::{
    parts::plot,
    series::{Chart, Floats, PlotLine, PlotPoint},
};

/// Lines of a check that failed which are shown above the table.
const SHOWN: usize = 8;
/// Plots of what failed; more would push everything else away.
const MOST_PLOTS: usize = 6;
/// Times of plots have 32 bits. Kind: rounding, of a run of some seconds.
const HALF_A_MICROSECOND_S: f64 = 5e-7;

/// A plot of a quantity that was violated.
pub(super) struct FailedPlot {
    pub(super) id: String,
    caption: String,
}

/// Marks the first violation of each quantity in its plot, which is one of `charts` or added to them.
pub(super) fn failed_plots(report: &RunReport, run: &RunContent, charts: &mut Vec<Chart>) -> Vec<FailedPlot> {
    let mut plots: Vec<FailedPlot> = Vec::new();
    for of in violated(report) {
        let known = shared_id(of.check.check, of.measure.quantity);
        let at = known.and_then(|id| charts.iter().position(|chart| chart.id == id));
        let at = match (at, of_check(of.number, of.measure, run)) {
            (Some(at), _) => at,
            (None, Some(chart)) => {
                charts.push(chart);
                charts.len() - 1
            }
            // A quantity that is known only at the end has no curve.
            (None, None) => continue,
        };
        let chart = &mut charts[at];
        mark(chart, of.measure, &run.series.times_s());
        if !plots.iter().any(|known| known.id == chart.id) && plots.len() < MOST_PLOTS {
            let words = caption(&chart.id).map_or_else(|| quantity_words(of.measure.quantity), str::to_owned);
            plots.push(FailedPlot { id: chart.id.clone(), caption: format!("{}: {words}", of.check.check) });
        }
    }
    plots
}

/// The plot that shows a quantity for several joints, links or pairs.
fn shared_id(check: CheckKind, quantity: Quantity) -> Option<&'static str> {
    match (check, quantity) {
        (CheckKind::Agreement, Quantity::Position) => Some("position"),
        (CheckKind::Agreement, Quantity::Orientation) => Some("orientation"),
        (CheckKind::Zone, Quantity::Distance) => Some("zones"),
        (_, Quantity::Distance) => Some("clearance"),
        (_, Quantity::PathErrorOfAngle | Quantity::GoalErrorOfAngle) => Some(tracking_id(SiUnit::Radian)),
        (_, Quantity::PathErrorOfShift | Quantity::GoalErrorOfShift) => Some(tracking_id(SiUnit::Metre)),
        _ => None,
    }
}

/// Adds the first violation to a plot, and the limit of an error at the goal.
fn mark(chart: &mut Chart, measure: &Measure, times_s: &Floats) {
    let Some(first) = &measure.first_violation else { return };
    let is_goal = matches!(measure.quantity, Quantity::GoalErrorOfAngle | Quantity::GoalErrorOfShift);
    if is_goal {
        let mut limit = limit_of(measure);
        limit.name = format!("goal {}", limit.name);
        // On an axis that reaches to the limits on the path, an error at the goal would be a flat line.
        chart.has_all_limits = !chart.points.is_empty();
        chart.limits.push(limit);
    }
    if !is_goal {
        chart.has_all_limits = true;
    }
    let (unit, scale) = axis(measure.unit);
    let which = if is_goal { "goal" } else { "first" };
    let text = format!("{which} at {}: {} {unit}", quantity(first.time_s, "s"), number(first.value * scale));
    // The curves of tracking have a sign, which the check does not report: that of the curve at the time.
    let line = chart.lines.iter().find(|line| line.name == first.subject);
    let is_below =
        line.and_then(|line| value_at(line, times_s, first.time_s)).is_some_and(|value| value < 0.0);
    let value = if is_below { -first.value } else { first.value };
    chart.points.push(PlotPoint { time_s: first.time_s, value, text: text.trim_end().to_owned() });
    // The sentence above the plot has the worst instant, which need not be the first.
    if let Some(worst) =
        measure.worst.as_ref().filter(|worst| !is_goal && worst.time_s > first.time_s + HALF_A_MICROSECOND_S)
    {
        let text = format!("worst: {} {unit}", number(worst.value * scale));
        let value = worst.value.copysign(value);
        chart.points.push(PlotPoint { time_s: worst.time_s, value, text: text.trim_end().to_owned() });
    }
}

/// The value of a line at a time, or the last before.
fn value_at(line: &PlotLine, times_s: &Floats, time_s: f64) -> Option<f32> {
    let times_s = line.times_s.as_ref().unwrap_or(times_s);
    let later = times_s.0.partition_point(|&at| f64::from(at) <= time_s + HALF_A_MICROSECOND_S);
    line.values.0.get(later.saturating_sub(1)).copied()
}

/// The section; nothing if no check failed.
pub(super) fn what_failed(report: &RunReport, run: &RunContent, plots: &[FailedPlot]) -> Markup {
    let checks = report.checks_failed_first().into_iter();
    let failed: Vec<_> = checks.filter(|check| check.status == Status::Fail).collect();
    let Some((first, others)) = failed.split_first() else { return html! {} };
    let mut figures = plots.iter();
    html! {
        section {
            h2 { @if report.verdict == Verdict::AsExpected { "What failed, as expected" } @else { "What failed" } }
            (sentences(first))
            div.first {
                @if let Some(figure) = figures.next() { (plot(&figure.id, &figure.caption)) }
                (scene(report, run))
            }
            @for check in others { (sentences(check)) }
            div.pairs { @for figure in figures { (plot(&figure.id, &figure.caption)) } }
        }
    }
}

/// A check that failed, in the sentences of the report.
fn sentences(check: &CheckResult) -> Markup {
    let lines = lines(check);
    html! {
        div.card.bad {
            h3 { (check.check) @if let Some(line) = check.line { span.small { " line " (line) " of the scenario" } } }
            ul { @for line in lines.iter().take(SHOWN) { li { (line) } } }
            @if lines.len() > SHOWN { p.small { "and " (lines.len() - SHOWN) " more in the report" } }
        }
    }
}
