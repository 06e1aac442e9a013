//! Motion of the joints: position, velocity and effort of each, with its limits. Joints that do not move come last,
//! folded.

use congruent_description::Joint;
use congruent_input::display::{position, quantity};
use maud::{Markup, html};

use super::content::RunContent;
use crate::{
    parts::plot,
    series::{Chart, JointQuantity, PlotLimit, PlotLine, Plots},
};

/// A joint whose range of positions in the run is smaller does not move. Unit: rad or m. Kind: choice.
const STANDSTILL: f32 = 1e-4;
/// Plotted quantities of a joint.
const PLOTTED: [JointQuantity; 3] = [JointQuantity::Position, JointQuantity::Velocity, JointQuantity::Effort];

/// The plots of all joints.
pub(super) fn charts(run: &RunContent) -> Vec<Chart> {
    let joints = 0..run.names.joints.len();
    joints.flat_map(|joint| PLOTTED.map(|quantity| chart(quantity, joint, run))).collect()
}

fn id(quantity: JointQuantity, joint: usize) -> String {
    let name = match quantity {
        JointQuantity::Velocity => "velocity",
        JointQuantity::Effort => "effort",
        _ => "position",
    };
    format!("{name}_{joint}")
}

fn described(joint: usize, run: &RunContent) -> &Joint {
    let robot = &run.description.robot;
    robot.joint(robot.movable_joints()[joint])
}

fn chart(plotted: JointQuantity, joint: usize, run: &RunContent) -> Chart {
    let of = described(joint, run);
    let (turn, slide) = (("deg", 1_f64.to_degrees()), ("mm", 1e3));
    let is_angular = of.kind.is_angular();
    let (unit, scale) = match plotted {
        JointQuantity::Velocity if is_angular => ("deg/s", turn.1),
        JointQuantity::Velocity => ("mm/s", slide.1),
        JointQuantity::Effort => (if is_angular { "N m" } else { "N" }, 1.0),
        _ if is_angular => turn,
        _ => slide,
    };
    let line = |name: &str, quantity: JointQuantity, dashed: bool| {
        let values = run.series.joint_values(quantity, joint)?;
        Some(PlotLine { name: name.to_owned(), values, dashed, ..PlotLine::default() })
    };
    let mut lines = Vec::new();
    match plotted {
        JointQuantity::Velocity => lines.extend(line("velocity", plotted, false)),
        JointQuantity::Effort => lines.extend(line("effort", plotted, false)),
        _ => {
            lines.extend(line("position", JointQuantity::Position, false));
            lines.extend(line("setpoint", JointQuantity::Setpoint, true));
            // Encoders that are right need no line.
            let ranges = [JointQuantity::Measured, JointQuantity::Position]
                .map(|quantity| run.series.range_of_joint(quantity, joint));
            if ranges[0] != ranges[1] {
                lines.extend(line("measured", JointQuantity::Measured, true));
            }
        }
    }
    // An effort that is 0 all the time is not known: the source of the run plays positions back.
    let range = run.series.range_of_joint(plotted, joint);
    if plotted == JointQuantity::Effort && range == Some((0.0, 0.0)) {
        lines.clear();
    }
    let limits = limits(plotted, of).into_iter().map(|value| PlotLimit { name: "limit".to_owned(), value });
    // How much of its actuator a joint uses is what its effort is plotted for; a range of positions may be far away.
    let has_all_limits = plotted == JointQuantity::Effort;
    Chart {
        id: id(plotted, joint),
        unit,
        scale,
        lines,
        limits: limits.collect(),
        has_all_limits,
        ..Chart::default()
    }
}

/// The limits of a joint that a description states; a limit of zero is none.
fn limits(quantity: JointQuantity, joint: &Joint) -> Vec<f64> {
    let stated = |limit: Option<f64>| {
        limit.filter(|&limit| limit > 0.0).map_or(Vec::new(), |limit| vec![-limit, limit])
    };
    match quantity {
        JointQuantity::Velocity => stated(joint.limit.and_then(|limit| limit.velocity)),
        JointQuantity::Effort => stated(joint.limit.and_then(|limit| limit.effort)),
        _ => joint.position_range().map_or(Vec::new(), |(lower, upper)| vec![lower, upper]),
    }
}

/// The plots: of joints that move, then the others, folded.
pub(super) fn joints(run: &RunContent, plots: &Plots) -> Markup {
    let moves = |joint: &usize| {
        let range = run.series.range_of_joint(JointQuantity::Position, *joint);
        range.is_some_and(|(low, high)| high - low > STANDSTILL)
    };
    let (moving, still): (Vec<usize>, Vec<usize>) = (0..run.names.joints.len()).partition(moves);
    if run.names.joints.is_empty() {
        return html! {};
    }
    html! {
        @for &joint in &moving { (one(joint, run, plots)) }
        @if !still.is_empty() {
            details {
                summary { (still.len()) @if still.len() == 1 { " joint that does not move" } @else { " joints that do not move" } }
                @for &joint in &still { (one(joint, run, plots)) }
            }
        }
    }
}

fn one(joint: usize, run: &RunContent, plots: &Plots) -> Markup {
    let of = described(joint, run);
    let has = |quantity: &JointQuantity| plots.charts.iter().any(|chart| chart.id == id(*quantity, joint));
    html! {
        div.joint {
            h3 { (run.names.joints[joint]) " " span.small { (range_words(joint, of, run)) } }
            div.plots {
                @for quantity in PLOTTED.iter().filter(|quantity| has(quantity)) {
                    (plot(&id(*quantity, joint), &caption(*quantity, of)))
                }
            }
        }
    }
}

/// From where to where a joint moved, and how far it stayed from its limits.
fn range_words(joint: usize, of: &Joint, run: &RunContent) -> String {
    let Some((low, high)) = run.series.range_of_joint(JointQuantity::Position, joint) else {
        return String::new();
    };
    let (low, high, unit) = (f64::from(low), f64::from(high), of.kind.unit());
    let went = format!("{} to {}", position(low, unit), position(high, unit));
    match of.position_range() {
        None => format!("{went}, without limits"),
        Some((lower, upper)) => {
            let margin = (low - lower).min(upper - high);
            let [lower, upper] = [lower, upper].map(|limit| position(limit, unit));
            let side = if margin < 0.0 { "beyond a limit by" } else { "margin" };
            format!("{went}, limits {lower} and {upper}: {side} {}", quantity(margin.abs(), unit))
        }
    }
}

fn caption(quantity_of: JointQuantity, joint: &Joint) -> String {
    let unit = if joint.kind.is_angular() { "rad" } else { "m" };
    let (name, unit) = match quantity_of {
        JointQuantity::Velocity => ("velocity", format!("{unit}/s")),
        JointQuantity::Effort => {
            ("effort", if joint.kind.is_angular() { "N m".to_owned() } else { "N".to_owned() })
        }
        _ => return "position".to_owned(),
    };
    match limits(quantity_of, joint).last() {
        Some(&limit) => format!("{name}, limit {}", quantity(limit, &unit)),
        None => format!("{name}, no limit stated"),
    }
}
