//! `play_csv`: the joints follow a table.

use std::sync::Arc;

use congruent_description::{Diagnostic, display::quantity};
use congruent_simulation::SPEED_MARGIN;

use super::{
    joint_path::check_positions,
    spline::{JointSpline, SplineEnds},
    table::{JointTable, MOST_BYTES, SAME_PLACE},
};
use crate::{
    motion::{
        course::{Course, Motion, PlannedMove, Way},
        planning::Planning,
        timing::Pace,
    },
    scenario::{Between, PlaybackMotion, Profile},
};

/// How many times its limit a derivative of a table may have: a table has few digits, and one that a run has written has what its
/// actuators allow.
const DIGITS: f64 = 1.0 + SPEED_MARGIN;

pub(in crate::motion) fn plan(
    settings: &PlaybackMotion,
    planning: &mut Planning<'_>,
) -> Result<Motion, Diagnostic> {
    let place = planning.place.key("play_csv");
    let robot = &planning.description.robot;
    let source = planning.folder.read_text(&settings.play_csv, MOST_BYTES);
    let table = source.and_then(|source| JointTable::read(&source, (robot, planning.limits), planning.from));
    let JointTable { times_s, mut points, places } =
        table.map_err(|fault| if fault.source.is_none() { place.mark(fault) } else { fault })?;
    for (coordinate, &joint) in robot.movable_joints().iter().enumerate() {
        let (stands, begins) = (planning.from[coordinate], points[0][coordinate]);
        if (stands - begins).abs() > SAME_PLACE {
            let joint = robot.joint(joint);
            let [stands, begins] = [stands, begins].map(|value| quantity(value, joint.kind.unit()));
            let message = format!(
                "the table begins with joint \"{}\" at {begins}, where it stands at {stands}",
                joint.name
            );
            let error = Diagnostic::error("scenario::playback_start", message);
            let help = "let the robot start there, or move the joints there before";
            return Err(place.mark(error.with_help(help)));
        }
    }
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
    let pace = Pace::Shape { profile: Profile::Linear, duration_s };
    let to = points.swap_remove(points.len() - 1);
    // Rows are held against the limits as they are read, a spline swings out between them.
    let planned = PlannedMove { way: Way::Spline(spline), to, pace, begins_s: 0.0 };
    let planned = planning.table_within_limits(planned, DIGITS, where_)?;
    let duration_s = planned.pace.duration_s();
    Ok(Motion { duration_s, course: Course::Planned(planned) })
}
