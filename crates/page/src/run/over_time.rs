//! Errors of the links, distances and tracking over time.

use congruent_agreement::compare::PoseSource;
use congruent_input::Quantity;
use congruent_monitors::verdict::{CheckResult, Measure, Status};
use congruent_results::report::{RunReport, share_in_full};
use congruent_scenario::CheckKind;
use maud::{Markup, html};

use super::{content::RunContent, joints};
use crate::{
    parts::plot,
    series::{Chart, JointQuantity, PlotLimit, PlotLine, PlotMark, Plots},
};

/// Lines of a plot that are shown before others are chosen.
const SHOWN: usize = 8;

/// All plots of a run.
pub(super) fn charts(report: &RunReport, run: &RunContent) -> Plots {
    let mut charts = vec![
        errors(Quantity::Position, report, run),
        errors(Quantity::Orientation, report, run),
        distances(report, run),
        tracking("tracking_angle", "deg", 1_f64.to_degrees(), report, run),
        tracking("tracking_shift", "mm", 1e3, report, run),
    ];
    charts.extend(joints::charts(run));
    charts.retain(|chart| !chart.lines.is_empty());
    Plots { times_s: run.series.times_s(), charts, marks: marks(report) }
}

/// Figures of the plots that are not of single joints.
pub(super) fn over_time(plots: &Plots) -> Markup {
    let figures = [
        ("position", "Distance between model and twin, for each link"),
        ("orientation", "Angle between model and twin, for each link"),
        ("clearance", "Smallest distance between links, to obstacles and to zones"),
        ("tracking_angle", "Setpoint minus position, of joints that turn"),
        ("tracking_shift", "Setpoint minus position, of joints that slide"),
    ];
    html! {
        section {
            h2 { "Over time" }
            noscript { p.error { "The plots need JavaScript. All values of the tables are here without it." } }
            p #script-error hidden {}
            @for (id, caption) in figures {
                @if plots.charts.iter().any(|chart| chart.id == id) { (plot(id, caption)) }
            }
        }
    }
}

/// Errors of all links; those of links that the table does not move follow from the URDF and are hidden.
fn errors(quantity: Quantity, report: &RunReport, run: &RunContent) -> Chart {
    let is_position = quantity == Quantity::Position;
    let agreement = report.checks.iter().filter(|check| check.check == CheckKind::Agreement);
    let measures = agreement.flat_map(|check| &check.measures).filter(|of| of.quantity == quantity);
    let worst: Vec<&str> = measures.filter_map(|of| Some(of.worst.as_ref()?.subject.as_str())).collect();
    let is_worst = |name: &str| worst.contains(&name);
    let mut lines: Vec<(f32, PlotLine)> = Vec::new();
    for (link, name) in run.names.links.iter().enumerate() {
        let error =
            if is_position { run.series.position_error(link) } else { run.series.orientation_error(link) };
        let Some((values, largest)) = error else { continue };
        // Model and twin both follow from the URDF there, so their error is rounding: hidden, not compared.
        let is_urdf = report.links.get(link).is_some_and(|of| of.source == PoseSource::Urdf);
        let has_table = report.links.iter().any(|of| of.source != PoseSource::Urdf);
        let hidden = largest == 0.0 || (is_urdf && has_table && !is_worst(name));
        lines.push((largest, PlotLine { name: name.clone(), values, hidden, ..PlotLine::default() }));
    }
    // Those shown come first, then the largest; of equal ones in the order of the robot.
    lines.sort_by(|(a, x), (b, y)| x.hidden.cmp(&y.hidden).then(b.total_cmp(a)));
    let mut lines: Vec<PlotLine> = lines.into_iter().map(|(_, line)| line).collect();
    lines.iter_mut().skip(SHOWN).for_each(|line| line.hidden = true);
    let limits =
        limits(report, |check, measure| check == CheckKind::Agreement && measure.quantity == quantity);
    let unit = if is_position { "m" } else { "rad" };
    Chart { id: quantity.name().to_owned(), unit, scale: 1.0, log: true, lines, limits }
}

fn distances(report: &RunReport, run: &RunContent) -> Chart {
    let nearest = &run.series.nearest;
    let lines = [
        nearest.clearance.line("links and obstacles", &run.names.pairs),
        nearest.zones.line("forbidden zones", &run.names.zones),
    ];
    let limits = limits(report, |check, _| {
        matches!(check, CheckKind::Clearance | CheckKind::Zone | CheckKind::Contact)
    });
    let lines = lines.into_iter().flatten().collect();
    Chart { id: "clearance".to_owned(), unit: "mm", scale: 1e3, log: false, lines, limits }
}

/// Tracking errors of the joints with this unit.
fn tracking(id: &str, unit: &'static str, scale: f64, report: &RunReport, run: &RunContent) -> Chart {
    let robot = &run.description.robot;
    let kinds = robot.movable_joints().iter().map(|&joint| robot.joint(joint).kind);
    let of_unit = kinds.enumerate().filter(|(_, kind)| kind.is_angular() == (unit == "deg"));
    let line = |joint: usize| {
        let values = run.series.joint_values(JointQuantity::TrackingError, joint)?;
        let (low, high) = run.series.range_of_joint(JointQuantity::TrackingError, joint)?;
        let name = run.names.joints[joint].clone();
        Some((high.max(-low), PlotLine { name, values, ..PlotLine::default() }))
    };
    let mut lines: Vec<(f32, PlotLine)> = of_unit.filter_map(|(joint, _)| line(joint)).collect();
    // The largest first: only the first ones are shown before others are chosen.
    lines.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let mut lines: Vec<PlotLine> = lines.into_iter().map(|(_, line)| line).collect();
    lines.iter_mut().skip(SHOWN).for_each(|line| line.hidden = true);
    let quantity = if unit == "deg" { Quantity::PathErrorOfAngle } else { Quantity::PathErrorOfShift };
    let mut limits =
        limits(report, |check, measure| check == CheckKind::Tracking && measure.quantity == quantity);
    // The error has a sign, its limit has none.
    limits.extend(limits.clone().into_iter().map(|limit| PlotLimit { value: -limit.value, ..limit }));
    Chart { id: id.to_owned(), unit, scale, log: false, lines, limits }
}

/// The limits of the measures that are chosen, each once.
fn limits(report: &RunReport, is_chosen: impl Fn(CheckKind, &Measure) -> bool) -> Vec<PlotLimit> {
    let mut limits: Vec<PlotLimit> = Vec::new();
    for check in &report.checks {
        for measure in check.measures.iter().filter(|measure| is_chosen(check.check, measure)) {
            let name = format!("{} {}", measure.bound.words(), share_in_full(measure.limit, measure.unit));
            if !limits.iter().any(|limit| limit.name == name) {
                limits.push(PlotLimit { name, value: measure.limit });
            }
        }
    }
    limits
}

/// First violations, the stop, and the starts of the motions.
fn marks(report: &RunReport) -> Vec<PlotMark> {
    let motion = |(number, motion): (usize, &congruent_results::report::MotionTimes)| PlotMark {
        time_s: motion.starts_s,
        text: number.to_string(),
        kind: "motion",
    };
    let failed = report.checks.iter().filter(|check| check.status == Status::Fail);
    let stop = report.stopped.iter().map(|stop| PlotMark {
        time_s: stop.time_s,
        text: "stop".to_owned(),
        kind: "stop",
    });
    (1..).zip(&report.motions).map(motion).chain(failed.filter_map(violation)).chain(stop).collect()
}

fn violation(check: &CheckResult) -> Option<PlotMark> {
    let first = check.measures.iter().filter_map(|measure| measure.first_violation.as_ref());
    let time_s = first.map(|moment| moment.time_s).min_by(f64::total_cmp)?;
    Some(PlotMark { time_s, text: check.check.word().to_owned(), kind: "violation" })
}
