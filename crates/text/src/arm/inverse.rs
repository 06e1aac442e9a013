//! What `congruent ik` prints.

use std::fmt::Write;

use congruent_analysis::inverse::{IkOptions, InverseReport, InverseSolution, NotReached, TargetPart};
use congruent_description::{Joint, Robot};
use congruent_input::display::{length, length_and_angle, listed, position};
use congruent_kinematics::{IkTarget, ReportedPose};

use crate::{TextOptions, layout::Table};

/// What `congruent ik` prints: for each target whether it is reached within the tolerances, and the joint positions. `first` is the
/// number of the first target; the chain is left out if that is not 1.
pub fn inverse_text(
    report: &InverseReport,
    robot: &Robot,
    searched: &IkOptions,
    first: usize,
    options: &TextOptions,
) -> String {
    let mut text = if first == 1 { format!("{}: {}\n", report.robot, report.chain) } else { String::new() };
    if report.results.is_empty() {
        text += "the file has no target\n";
    }
    for (index, result) in report.results.iter().enumerate() {
        let _ = writeln!(
            text,
            "target {}, {}: {} after {} steps, residual {}, tolerance {}",
            first + index,
            pose(&result.target),
            reached(result),
            result.iterations,
            length_and_angle(result.residual_position_m, result.residual_orientation_rad),
            match result.target.part {
                TargetPart::Position => format!("{} (any orientation)", length(searched.tolerance_m)),
                TargetPart::Pose => length_and_angle(searched.tolerance_m, searched.tolerance_rad),
            }
        );
        joints(&mut text, result, robot, options);
    }
    text
}

/// Whether a target is reached, and if not, why.
fn reached(result: &InverseSolution) -> String {
    match result.not_reached {
        _ if result.converged => "reached".to_owned(),
        None => "NOT REACHED".to_owned(),
        Some(NotReached::Orientation) => format!(
            "NOT REACHED: the position can be reached, but not in this orientation{};",
            held_by(&result.limits_held)
        ),
        Some(NotReached::OutOfReach { distance_m, reach_m }) => format!(
            "OUT OF REACH: {} from the first joint, the arm reaches at most {}{};",
            length(distance_m),
            length(reach_m),
            in_millimetres(&result.target, distance_m, reach_m)
        ),
    }
}

/// The joints whose limits stop the arm nearest to the target.
fn held_by(joints: &[String]) -> String {
    let names: Vec<&str> = joints.iter().map(String::as_str).collect();
    match names.len() {
        0 => String::new(),
        1 => format!(": {} is at its limit", listed(&names)),
        _ => format!(": {} are at their limits", listed(&names)),
    }
}

/// The pose of a target: its position, and roll, pitch and yaw if it prescribes them.
fn pose(target: &IkTarget) -> String {
    let reported = ReportedPose::from(&target.base_from_tcp);
    let xyz = reported.translation_m.map(length).join(", ");
    match target.part {
        TargetPart::Position => format!("[{xyz}]"),
        TargetPart::Pose => {
            let rpy = reported.rpy_rad().map(|angle| position(angle, "rad")).join(", ");
            format!("[{xyz}], roll, pitch, yaw [{rpy}]")
        }
    }
}

/// The hint that a target was meant in mm, if it would then be within reach, or nearly.
fn in_millimetres(target: &IkTarget, distance_m: f64, reach_m: f64) -> String {
    /// A target that is farther than this multiple of the reach is no target that was missed by a little. Kind: choice.
    const FAR: f64 = 20.0;
    /// One in mm that is missed by a little was meant in mm as well. Kind: choice.
    const NEAR: f64 = 2.0;
    if distance_m < FAR * reach_m || distance_m / 1000.0 > NEAR * reach_m {
        return String::new();
    }
    let xyz = target.base_from_tcp.translation;
    let xyz = [xyz.x, xyz.y, xyz.z].map(|value| format!("{value}mm")).join(",");
    format!(" (in mm? --xyz {xyz})")
}

/// Each joint with its position, its margin to the nearer limit, and its range.
fn joints(text: &mut String, result: &InverseSolution, robot: &Robot, options: &TextOptions) {
    let mut table = Table::headed(["joint", "position", "margin", "range"]);
    for (name, value) in result.q.iter() {
        let joint = robot.find_joint(name).map(|joint| robot.joint(joint));
        let unit = joint.map_or("", |joint| joint.kind.unit());
        let [margin, range] = match joint.and_then(Joint::position_range) {
            None => ["no limit".to_owned(), String::new()],
            Some((lower, upper)) => {
                let is_held = result.limits_held.iter().any(|held| held == name);
                let margin = position((value - lower).min(upper - value), unit);
                let ends = format!("{} to {}", position(lower, unit), position(upper, unit));
                [if is_held { "at its limit".to_owned() } else { margin }, ends]
            }
        };
        table.row([name.to_owned(), position(value, unit), margin, range]);
    }
    table.write(text, options.columns);
}
