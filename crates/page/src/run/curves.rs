//! The curves that are not of single joints: errors of the links, distances, tracking. Each plot has the worst few lines.

use congruent_agreement::compare::PoseSource;
use congruent_input::{
    Quantity, SiUnit,
    display::{angle, length},
};
use congruent_monitors::verdict::Measure;
use congruent_results::report::{RunReport, quantity_words, share_in_full};
use congruent_scenario::CheckKind;

use super::content::RunContent;
use crate::series::{Chart, JointQuantity, PlotLimit, PlotLine};

/// Lines of a plot; the others are less, and a legend of all would hide which is worst.
const MOST_LINES: usize = 5;
/// Errors below are rounding, which no plot shows: 1 pm and 1 prad. Unit: m or rad. Kind: rounding of poses, some 1e-15 for
/// each metre and joint.
const ROUNDING: f32 = 1e-12;

/// A plot, or the sentence that says why there is none.
pub(super) enum PlottedCurve {
    Plot(Chart),
    Text(String),
}

/// Unit of the axis, and how many of it are one SI unit.
pub(super) fn axis(unit: SiUnit) -> (&'static str, f64) {
    let degrees = 1_f64.to_degrees();
    match unit {
        SiUnit::Metre => ("mm", 1e3),
        SiUnit::Radian => ("deg", degrees),
        SiUnit::MetrePerSecond => ("mm/s", 1e3),
        SiUnit::RadianPerSecond => ("deg/s", degrees),
        _ => (unit.symbol(), 1.0),
    }
}

/// The worst lines, each with its largest value; how many others there are.
fn worst(mut lines: Vec<(f32, PlotLine)>) -> (Vec<PlotLine>, usize) {
    lines.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let others = lines.len().saturating_sub(MOST_LINES);
    (lines.into_iter().take(MOST_LINES).map(|(_, line)| line).collect(), others)
}

/// Errors of the links, those whose pose is the URDF's in model and twin left out: their error is rounding.
pub(super) fn errors(quantity: Quantity, report: &RunReport, run: &RunContent) -> Option<PlottedCurve> {
    let is_position = quantity == Quantity::Position;
    let agreement =
        |check: CheckKind, measure: &Measure| check == CheckKind::Agreement && measure.quantity == quantity;
    let measures = report.checks.iter().flat_map(|check| check.measures.iter().map(|of| (check.check, of)));
    let subjects: Vec<&str> = measures
        .filter(|(check, of)| agreement(*check, of))
        .filter_map(|(_, of)| Some(of.worst.as_ref()?.subject.as_str()))
        .collect();
    let has_table = report.links.iter().any(|of| of.source != PoseSource::Urdf);
    let mut lines: Vec<(f32, PlotLine)> = Vec::new();
    for (link, name) in run.names.links.iter().enumerate() {
        let error =
            if is_position { run.series.position_error(link) } else { run.series.orientation_error(link) };
        let Some((values, largest)) = error else { continue };
        let is_urdf = report.links.get(link).is_some_and(|of| of.source == PoseSource::Urdf);
        // What a check reports is plotted in any case.
        if !(is_urdf && has_table) || subjects.contains(&name.as_str()) {
            lines.push((largest, PlotLine { name: name.clone(), values, ..PlotLine::default() }));
        }
    }
    let largest = lines.iter().map(|(largest, _)| *largest).reduce(f32::max)?;
    if largest <= ROUNDING {
        let (what, limit) = if is_position { ("distance", length(1e-12)) } else { ("angle", angle(1e-12)) };
        return Some(PlottedCurve::Text(format!(
            "The {what} between model and twin is never above {limit} at any link: rounding, not plotted."
        )));
    }
    let (lines, others) = worst(lines);
    let (unit, scale) = axis(if is_position { SiUnit::Metre } else { SiUnit::Radian });
    let (id, limits) = (quantity.name().to_owned(), limits(report, agreement));
    Some(PlottedCurve::Plot(Chart { id, unit, scale, log: true, lines, limits, others, ..Chart::default() }))
}

/// The smallest distances between links and to obstacles, of pairs whose distance can change.
pub(super) fn clearance(report: &RunReport, run: &RunContent) -> Option<Chart> {
    let nearest = &run.series.nearest;
    let lines = [
        nearest.obstacles.line("nearest obstacle", &run.names.pairs),
        nearest.links.line("nearest two links", &run.names.pairs),
    ];
    let is_chosen = |check: CheckKind, of: &Measure| is_distance(of) && check != CheckKind::Zone;
    distances("clearance", lines.into_iter().flatten().collect(), limits(report, is_chosen))
}

/// The smallest distance to a zone of a link that may not enter it.
pub(super) fn zones(report: &RunReport, run: &RunContent) -> Option<Chart> {
    let line = run.series.nearest.zones.line("nearest zone", &run.names.zones)?;
    distances("zones", vec![line], limits(report, |check, of| is_distance(of) && check == CheckKind::Zone))
}

fn is_distance(measure: &Measure) -> bool {
    measure.quantity == Quantity::Distance
}

fn distances(id: &str, lines: Vec<PlotLine>, limits: Vec<PlotLimit>) -> Option<Chart> {
    let (unit, scale) = axis(SiUnit::Metre);
    let chart = Chart { id: id.to_owned(), unit, scale, lines, limits, ..Chart::default() };
    (!chart.lines.is_empty()).then_some(chart)
}

/// Tracking errors of the joints with this unit.
pub(super) fn tracking(unit: SiUnit, report: &RunReport, run: &RunContent) -> Option<PlottedCurve> {
    let robot = &run.description.robot;
    let joints = robot.movable_joints().iter().map(|&joint| robot.joint(joint).kind.si_unit());
    let line = |joint: usize| {
        let values = run.series.joint_values(JointQuantity::TrackingError, joint)?;
        let (low, high) = run.series.range_of_joint(JointQuantity::TrackingError, joint)?;
        let name = run.names.joints[joint].clone();
        Some((high.max(-low), PlotLine { name, values, ..PlotLine::default() }))
    };
    let of_unit = joints.enumerate().filter(|(_, of)| *of == unit);
    let lines: Vec<(f32, PlotLine)> = of_unit.filter_map(|(joint, _)| line(joint)).collect();
    let largest = lines.iter().map(|(largest, _)| *largest).reduce(f32::max)?;
    let turns = unit == SiUnit::Radian;
    if largest <= ROUNDING {
        let which = if turns { "turns" } else { "slides" };
        return Some(PlottedCurve::Text(format!(
            "Every joint that {which} is at its setpoint all the time."
        )));
    }
    let quantity = if turns { Quantity::PathErrorOfAngle } else { Quantity::PathErrorOfShift };
    let mut limits =
        limits(report, |check, measure| check == CheckKind::Tracking && measure.quantity == quantity);
    // The error has a sign, its limit has none: one name for both lines.
    let mirrored = limits.iter().map(|limit| PlotLimit { name: String::new(), value: -limit.value });
    limits.extend(mirrored.collect::<Vec<_>>());
    let (lines, others) = worst(lines);
    let ((unit, scale), id) = (axis(unit), tracking_id(unit).to_owned());
    Some(PlottedCurve::Plot(Chart { id, unit, scale, lines, limits, others, ..Chart::default() }))
}

/// The name of the plot of tracking errors.
pub(super) fn tracking_id(unit: SiUnit) -> &'static str {
    if unit == SiUnit::Radian { "tracking_angle" } else { "tracking_shift" }
}

/// The curve of what a check measured; `None` if it is known only at the end.
pub(super) fn of_check(check: usize, measure: &Measure, run: &RunContent) -> Option<Chart> {
    let name = quantity_words(measure.quantity);
    let line = run.series.checked.line(check, measure.quantity, &name)?;
    let (unit, scale) = axis(measure.unit);
    Some(Chart {
        id: format!("check_{}_{}", check + 1, measure.quantity),
        unit,
        scale,
        lines: vec![line],
        limits: vec![limit_of(measure)],
        has_all_limits: true,
        ..Chart::default()
    })
}

/// The limit of a measure as a line.
pub(super) fn limit_of(measure: &Measure) -> PlotLimit {
    let name = format!("{} {}", measure.bound.words(), share_in_full(measure.limit, measure.unit));
    PlotLimit { name, value: measure.limit }
}

/// The limits of the measures that are chosen, each once.
fn limits(report: &RunReport, is_chosen: impl Fn(CheckKind, &Measure) -> bool) -> Vec<PlotLimit> {
    let mut limits: Vec<PlotLimit> = Vec::new();
    for check in &report.checks {
        for measure in check.measures.iter().filter(|measure| is_chosen(check.check, measure)) {
            let limit = limit_of(measure);
            if !limits.iter().any(|known| known.name == limit.name) {
                limits.push(limit);
            }
        }
    }
    limits
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plot_has_the_worst_five_lines() {
        let line = |name: &str| PlotLine { name: name.to_owned(), ..PlotLine::default() };
        let all = [("a", 1.0), ("b", 7.0), ("c", 3.0), ("d", 2.0), ("e", 9.0), ("f", 4.0), ("g", 0.5)];
        let (lines, others) = worst(Vec::from(all.map(|(name, largest)| (largest, line(name)))));
        let names: Vec<&str> = lines.iter().map(|line| line.name.as_str()).collect();
        assert_eq!((names, others), (vec!["e", "b", "f", "c", "d"], 2));
    }

    #[test]
    fn an_axis_has_the_unit_that_engineers_read() {
        let units = [SiUnit::Metre, SiUnit::RadianPerSecond, SiUnit::NewtonMetre, SiUnit::Ratio];
        assert_eq!(units.map(|unit| axis(unit).0), ["mm", "deg/s", "N m", ""]);
    }
}
