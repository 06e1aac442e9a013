//! `play_csv`: the joints follow a table.

use std::sync::Arc;

use congruent_description::SPEED_MARGIN;
use congruent_input::{Diagnostic, display::quantity};
use congruent_scenario::{Between, PlaybackMotion, Profile};
use congruent_tables::read_table;

use super::{
    joint_path::check_positions,
    table::{JointTable, MOST_BYTES, SAME_PLACE},
};
use crate::{
    JointSpacePath, Motion, MotionPlan, PlannedMove, TimeScaling, codes,
    planning::Planning,
    spline::{JointSpline, SplineEnds},
};

/// Factor by which a derivative of a table may exceed its limit: a table has few digits, and a table that a run has written
/// contains the speeds that the actuators allow.
const DIGITS: f64 = 1.0 + SPEED_MARGIN;

pub(crate) fn plan(settings: &PlaybackMotion, planning: &mut Planning<'_>) -> Result<Motion, Diagnostic> {
    let place = planning.place.key("play_csv");
    let robot = &planning.description.robot;
    let path = planning.folder.path.join(&settings.play_csv);
    let source = read_table(planning.folder.access, &path, MOST_BYTES);
    let table = source.and_then(|source| JointTable::read(&source, planning));
    let JointTable { times_s, mut points, places } =
        table.map_err(|fault| if fault.source.is_none() { place.mark(fault) } else { fault })?;
    for (coordinate, &joint) in robot.movable_joints().iter().enumerate() {
        let (present, begins) = (planning.from[coordinate], points[0][coordinate]);
        if (present - begins).abs() > SAME_PLACE {
            let joint = robot.joint(joint);
            let [present, begins] = [present, begins].map(|value| quantity(value, joint.kind.unit()));
            let message = format!(
                "joint \"{}\" is at {present} when the playback begins, but the table begins at {begins}",
                joint.name
            );
            let error = Diagnostic::error(codes::scenario::PLAYBACK_START, message);
            let help =
                "start the robot at the first row of the table, or move the joints there before the playback";
            return Err(place.mark(error.with_help(help)));
        }
    }
    // Within `SAME_PLACE`, so the setpoint starts without even that jump.
    points[0].clone_from(planning.from);
    let duration_s = times_s[times_s.len() - 1];
    let shares: Vec<f64> = times_s.iter().map(|time_s| time_s / duration_s).collect();
    let ends = match settings.between {
        Between::Spline => SplineEnds::Parabola,
        Between::Linear => SplineEnds::Straight,
    };
    let spline = Arc::new(JointSpline::new(&shares, &points, ends));
    let where_ =
        |joint: usize, time_s: f64| places.between(joint, times_s.partition_point(|&row_s| row_s <= time_s));
    check_positions(&spline, duration_s, planning, where_)?;
    let time_scaling = TimeScaling::Shape { profile: Profile::Linear, duration_s };
    let to = points.swap_remove(points.len() - 1);
    // Rows are compared with the limits as they are read, but a spline overshoots between them.
    let planned = PlannedMove { joint_path: JointSpacePath::Spline(spline), to, time_scaling, begins_s: 0.0 };
    let planned = planning.table_within_limits(planned, DIGITS, where_)?;
    let duration_s = planned.time_scaling.duration_s();
    Ok(Motion { duration_s, motion_plan: MotionPlan::Planned(planned) })
}
