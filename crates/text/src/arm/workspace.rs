//! What `congruent workspace` prints.

use std::fmt::Write;

use congruent_analysis::workspace::WorkspaceReport;
use congruent_description::Robot;
use congruent_input::display::{in_column, position, quantity};
use congruent_kinematics::range;

use crate::{
    TextOptions,
    layout::{Table, wrapped},
};

/// An interval wider than this share of the estimate is worth a remark.
const WIDE: f64 = 0.1;

/// What `congruent workspace` prints: nearest and farthest position of the tool, bounding box, and volume or area.
pub fn workspace_text(report: &WorkspaceReport, robot: &Robot, options: &TextOptions) -> String {
    let mut text = format!("{}: {}\n", report.robot, report.chain);
    let _ = writeln!(text, "the tool in link {}, {} configurations", report.chain.base, report.samples);
    for (name, reach) in ["nearest", "farthest"].iter().zip(&report.reach) {
        let distance = position(reach.distance_m, "m");
        let _ = writeln!(text, "  {name} {distance} from the base's origin, at");
        text += &wrapped(&reach.at.for_people(robot));
    }
    let mut table = Table::headed(["", "lower mm", "upper mm"]);
    for (at, axis) in ["x", "y", "z"].into_iter().enumerate() {
        let ends = [report.lower_m[at], report.upper_m[at]].map(|end| in_column(end, "m"));
        table.row([axis.to_owned()].into_iter().chain(ends));
    }
    table.write(&mut text, options.columns);
    size(&mut text, report);
    assumed_ranges(&mut text, report, robot);
    text
}

/// The ranges that were taken for joints that slide without one: the workspace is as large as these.
fn assumed_ranges(text: &mut String, report: &WorkspaceReport, robot: &Robot) {
    let joints = report.chain.joints.iter().filter_map(|name| Some(robot.joint(robot.find_joint(name)?)));
    for joint in joints.filter(|joint| joint.largest_shift_m().is_infinite()) {
        let (lower, upper) = range(joint);
        let [lower, upper] = [lower, upper].map(|end| position(end, "m"));
        let _ =
            writeln!(text, "  joint \"{}\" slides without a range: {lower} to {upper} are taken", joint.name);
    }
}

fn size(text: &mut String, report: &WorkspaceReport) {
    let (name, size, unit) = match (report.volume_m3, report.area_m2) {
        (Some(volume_m3), _) => ("volume", volume_m3, "m3"),
        (_, Some(area_m2)) => ("area", area_m2, "m2"),
        _ => return,
    };
    let [lower, upper] = report.between.unwrap_or([size; 2]);
    if report.points == 0 {
        let what = if name == "volume" { "surface" } else { "curve" };
        let _ = writeln!(text, "  {name} 0: the tool stays on a {what}");
        return;
    }
    let _ = writeln!(
        text,
        "  {name} {}, between {} and {} (three standard errors, {} points tested)",
        quantity(size, unit),
        quantity(lower - third_digit(lower) / 2.0, unit),
        quantity(upper + third_digit(upper) / 2.0, unit),
        report.points
    );
    if upper - lower > WIDE * size {
        let _ = writeln!(text, "  the interval is wide: more --samples narrow it");
    }
}

/// One unit of the third digit, of which half makes rounding go outwards.
fn third_digit(value: f64) -> f64 {
    if value > 0.0 { libm::pow(10_f64, libm::log10(value).floor() - 2.0) } else { 0.0 }
}
