//! Tables with numbers that are probably in another unit, judged by the robot that they are of.

use std::{collections::BTreeMap, ops::Range, sync::Arc};

use congruent_analysis::inverse::InverseTargets;
use congruent_calibration::measurements::MeasuredRow;
use congruent_configurations::outside_limits;
use congruent_description::{Robot, RobotDescription};
use congruent_input::{Diagnostic, Diagnostics, SourceFile, display::length};
use congruent_kinematics::Pose;

use crate::codes;

/// From the middle of all measured points, in reaches of the robot: two points that it can reach are at most two
/// reaches apart, and a wrong unit is a factor of ten or more.
const FARTHEST_MEASURED: f64 = 5.0;
/// From the base, in reaches of the robot: the first axis may be some reaches away from it.
const FARTHEST_TARGET: f64 = 10.0;

/// Rows of measurements at positions outside the limits, and points that the robot cannot reach. Their frame may be far from
/// the robot, so that they are judged against each other.
pub(crate) fn measured(
    rows: &[MeasuredRow],
    description: &RobotDescription,
    source: &Arc<SourceFile>,
) -> Vec<Diagnostic> {
    let mut found = Diagnostics::default();
    let lines = lines(&source.text);
    let reach_m = description.tolerance_scale().reach_m();
    // The median of each axis: one point in millimetres among points in metres does not move it, as it would a
    // mean.
    let middle_m: [Option<f64>; 3] =
        std::array::from_fn(|axis| middle(rows.iter().filter_map(|row| row.tip_in_base_m[axis])));
    for row in rows {
        let at = || lines.get(row.line.saturating_sub(1)).cloned().unwrap_or_default();
        for what in outside_limits(&positions(row, &description.robot), &description.robot) {
            let message = format!("line {} is outside the joint limits: {what}", row.line);
            let warning = Diagnostic::warning(codes::measurements::OUTSIDE_LIMITS, message)
                .one_of("measurements are outside the joint limits", format!("line {}", row.line))
                .with_help("the ending of a column's name is its unit (_rad, _deg, _m, _mm): do the values have that unit?");
            found.push(warning.at(at()));
        }
        let away_m = distance_m(&row.tip_in_base_m, &middle_m);
        if let Some(reach_m) = reach_m.filter(|reach_m| away_m > FARTHEST_MEASURED * reach_m) {
            let message = format!(
                "line {}: the measured point is {} from the median of all points, but the reach of the robot is {}",
                row.line,
                length(away_m),
                length(reach_m)
            );
            let warning = Diagnostic::warning(codes::units::MEASURED_POINT, message)
                .one_of(
                    "measured points are farther apart than the robot reaches",
                    format!("line {}", row.line),
                )
                .with_help("a column that ends in _m is in metres: is it in millimetres?");
            found.push(warning.at(at()));
        }
    }
    found.in_file(source)
}

/// Targets that are far beyond the reach of the robot.
pub(crate) fn targets(targets: &InverseTargets, description: &RobotDescription) -> Vec<Diagnostic> {
    let Some(reach_m) = description.tolerance_scale().reach_m() else { return Vec::new() };
    let mut found = Diagnostics::default();
    for (index, target) in targets.targets.iter().enumerate() {
        let away_m = target.target.base_from_tcp.distance_m(&Pose::identity());
        if away_m > FARTHEST_TARGET * reach_m {
            let message = format!(
                "target {} is {} from the base, and the reach of the robot is {}",
                index + 1,
                length(away_m),
                length(reach_m)
            );
            let warning = Diagnostic::warning(codes::units::TARGET, message)
                .one_of("targets are far beyond the reach of the robot", format!("target {}", index + 1))
                .with_help("translation_m is in metres: is it in millimetres?");
            found.push(warning);
        }
    }
    found.into_vec()
}

fn positions(row: &MeasuredRow, robot: &Robot) -> BTreeMap<String, f64> {
    let joints = robot.movable_joints().iter().map(|&joint| robot.joint(joint).name.clone());
    joints.zip(row.q.iter().copied()).collect()
}

/// The middle value; of an even number the lower one.
fn middle(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len().checked_sub(1)? / 2).copied()
}

fn distance_m(one: &[Option<f64>; 3], other: &[Option<f64>; 3]) -> f64 {
    let squares =
        one.iter().zip(other).filter_map(|(one, other)| Some((one.as_ref()? - other.as_ref()?).powi(2)));
    squares.sum::<f64>().sqrt()
}

/// Where each line of a text is.
fn lines(text: &str) -> Vec<Range<usize>> {
    let line = |end: &mut usize, line: &str| {
        let start = *end;
        *end += line.len();
        Some(start..start + line.trim_end().len())
    };
    text.split_inclusive('\n').scan(0, line).collect()
}
