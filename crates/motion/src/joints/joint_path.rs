//! `path_joints_*`: the joints pass many points along a spline.

use std::{collections::BTreeMap, sync::Arc};

use congruent_description::RobotQ;
use congruent_input::{Diagnostic, Findings, display::quantity};
use congruent_scenario::{JointPathMotion, Profile, mark};

use crate::{
    JointSpacePath, JointTargets, Motion, MotionPlan, PlannedMove, TimeScaling, codes,
    planning::{Planning, no_velocity_limit, nothing_moves},
    spline::{JointSpline, SplineEnds, SplineValues},
};

/// Intervals between two knots at whose ends a spline is evaluated.
const BETWEEN_KNOTS: usize = 16;

pub(crate) fn plan(settings: &JointPathMotion, planning: &mut Planning<'_>) -> Result<Motion, Findings> {
    let points = points(settings, planning)?;
    let times_s = times(settings, &points, planning)?;
    let total_s = times_s[times_s.len() - 1];
    let knots: Vec<f64> = times_s.iter().map(|time_s| time_s / total_s).collect();
    let spline = JointSpline::new(&knots, &points, SplineEnds::Rest);
    // Times in proportion are enough for the shape; the duration follows from it below.
    let is_given = settings.duration_s.is_some() || !settings.at_s.is_empty();
    let duration_s = if is_given { total_s } else { least_s(&spline, planning) };
    // Before the limits of speed: a path beyond the range is wrong at any duration.
    check_positions(&spline, duration_s, planning, |_, _| String::new())?;
    // Linear, since the spline over the share is itself at rest at both ends.
    let time_scaling = TimeScaling::Shape { profile: Profile::Linear, duration_s };
    let to = points[points.len() - 1].clone();
    let planned =
        PlannedMove { joint_path: JointSpacePath::Spline(Arc::new(spline)), to, time_scaling, begins_s: 0.0 };
    let planned = planning.within_limits(planned, |_| String::new())?;
    Ok(Motion { duration_s: planned.time_scaling.duration_s(), motion_plan: MotionPlan::Planned(planned) })
}

/// The start and all points.
fn points(settings: &JointPathMotion, planning: &mut Planning<'_>) -> Result<Vec<RobotQ>, Findings> {
    let robot = &planning.description.robot;
    let groups = [
        &settings.path_joints_deg,
        &settings.path_joints_rad,
        &settings.path_joints_m,
        &settings.path_joints_mm,
    ];
    let given: Vec<usize> = groups.iter().map(|group| group.len()).filter(|&count| count > 0).collect();
    let count = given.first().copied().unwrap_or(0);
    // Each group has all points: entries of one point are at the same place in each list.
    if count == 0 || given.iter().any(|&other| other != count) {
        let error = Diagnostic::error(
            codes::scenario::PATH_POINTS,
            "the path has no points, or lists of unequal length",
        );
        let help = "give a list of points, [{ joint = 10 }, { joint = 20 }], of the same length under each path_joints_* key";
        return Err(planning.place.mark(error.with_help(help)).into());
    }
    let (mut points, none) = (vec![planning.from.clone()], BTreeMap::new());
    for point in 0..count {
        // Joints that a point does not name stay where the point before has them.
        let mut q = points[point].clone();
        for target in JointTargets::of_point(settings, point, &none).resolve(robot, planning.place)? {
            if let Some(message) = target.beyond_limits(robot, "target") {
                let warning = Diagnostic::warning(codes::scenario::TARGET_LIMIT, message);
                planning.warnings.push(mark(warning, target.span.clone()));
            }
            target.put(robot, &mut q);
        }
        robot.apply_mimic(&mut q);
        points.push(q);
    }
    Ok(points)
}

/// Time at which each point is passed, the start at 0; only in proportion if the least time is sought.
fn times(
    settings: &JointPathMotion,
    points: &[RobotQ],
    planning: &Planning<'_>,
) -> Result<Vec<f64>, Diagnostic> {
    if settings.at_s.is_empty() {
        return spaced(points, settings.duration_s, planning);
    }
    let place = planning.place.key("at_s");
    let refused = |message: String| place.mark(Diagnostic::error(codes::scenario::PATH_TIMES, message));
    if settings.duration_s.is_some() {
        return Err(refused(
            "`at_s` and `duration_s` cannot be given together: remove one of them".to_owned(),
        ));
    }
    let (times, count) = (settings.at_s.len(), points.len() - 1);
    if times != count {
        return Err(refused(format!("`at_s` has {times} times for {count} points")));
    }
    let mut all = vec![0.0];
    for (index, &time_s) in settings.at_s.iter().enumerate() {
        if !(time_s.is_finite() && time_s > all[index]) {
            let message = format!(
                "time {} is {time_s} s, but must be later than {} s, the time before",
                index + 1,
                all[index]
            );
            let error = Diagnostic::error(codes::scenario::PATH_TIMES, message);
            let help = "times count from the start of the motion, and each must be later than the one before";
            return Err(place.item(index).mark(error.with_help(help)));
        }
        all.push(time_s);
    }
    Ok(all)
}

/// Times of the points such that, from each to the next, the slowest joint moves at its velocity limit.
fn spaced(
    points: &[RobotQ],
    duration_s: Option<f64>,
    planning: &Planning<'_>,
) -> Result<Vec<f64>, Diagnostic> {
    let velocity = &planning.limits.velocity;
    let mut times_s = vec![0.0];
    for (index, pair) in points.windows(2).enumerate() {
        let changes = || pair[0].iter().zip(&pair[1]).map(|(from, to)| (to - from).abs());
        let unlimited =
            changes().zip(velocity).position(|(change, limit)| change > 0.0 && limit.is_infinite());
        if let (Some(coordinate), None) = (unlimited, duration_s) {
            return Err(no_velocity_limit(planning, coordinate));
        }
        let longest = match unlimited {
            // A joint has no limit, but the duration is given: the times are scaled to it, and only proportions count.
            Some(_) => changes().fold(0.0, f64::max),
            None => changes().zip(velocity).map(|(change, limit)| change / limit).fold(0.0, f64::max),
        };
        // The path has one point only, so the message of a move applies.
        if longest == 0.0 && duration_s.is_none() && points.len() == 2 {
            return Err(nothing_moves(planning));
        }
        if longest == 0.0 {
            let message = format!("point {} equals the point before it", index + 1);
            let error = Diagnostic::error(codes::scenario::PATH_POINTS, message);
            return Err(planning.place.mark(error.with_help("remove it, or give `at_s` to wait there")));
        }
        times_s.push(times_s[index] + longest);
    }
    let scale = duration_s.map_or(1.0, |duration_s| duration_s / times_s[times_s.len() - 1]);
    Ok(times_s.into_iter().map(|time_s| time_s * scale).collect())
}

/// The least duration in which a spline over the share of the path keeps all limits: the n-th derivative of the spline over
/// the share, divided by T^n, must be within the limit.
fn least_s(spline: &JointSpline, planning: &Planning<'_>) -> f64 {
    let limits = planning.limits;
    let mut least_s = 0.0_f64;
    look(spline, limits.velocity.len(), |_, values| {
        for joint in 0..limits.velocity.len() {
            let velocity_s = values.first[joint].abs() / limits.velocity[joint];
            let acceleration_s = (values.second[joint].abs() / limits.acceleration[joint]).sqrt();
            least_s = least_s.max(velocity_s).max(acceleration_s);
        }
        true
    });
    let jerk_s = |joint: usize| libm::cbrt(spline.largest_third(joint) / limits.jerk[joint]);
    (0..limits.jerk.len()).map(jerk_s).fold(least_s, f64::max)
}

/// Refuses a spline that is outside the range of a joint between points that are inside; `where_` names the points around a
/// time, for the message.
pub(super) fn check_positions(
    spline: &JointSpline,
    duration_s: f64,
    planning: &Planning<'_>,
    where_: impl Fn(usize, f64) -> String,
) -> Result<(), Diagnostic> {
    let robot = &planning.description.robot;
    let joints: Vec<_> = robot.movable_joints().iter().map(|&joint| robot.joint(joint)).collect();
    let mut outside = None;
    // Points beyond the limits have a warning of their own, so that only overshoot between points is refused here.
    let is_outside = |joint: usize, q: f64| {
        // 1e-9: rounding of the spline at a point that lies on the limit.
        joints[joint].position_range().is_some_and(|(lower, upper)| q < lower - 1e-9 || q > upper + 1e-9)
    };
    let points_inside = |joint: usize| {
        let (mut q, mut first, mut second) =
            (vec![0.0; joints.len()], vec![0.0; joints.len()], vec![0.0; joints.len()]);
        spline.knots().iter().all(|&knot| {
            spline.at(knot, SplineValues { q: &mut q, first: &mut first, second: &mut second });
            !is_outside(joint, q[joint])
        })
    };
    look(spline, joints.len(), |share, values| {
        outside = (0..joints.len())
            .find(|&joint| is_outside(joint, values.q[joint]))
            .map(|joint| (joint, share, values.q[joint]));
        outside.is_none()
    });
    let Some((joint, share, q)) = outside else { return Ok(()) };
    if !points_inside(joint) {
        return Ok(());
    }
    let (name, unit) = (&joints[joint].name, joints[joint].kind.unit());
    let (lower, upper) = joints[joint].position_range().unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
    let [q, lower, upper] = [q, lower, upper].map(|value| quantity(value, unit));
    let (time, where_) = (quantity(share * duration_s, "s"), where_(joint, share * duration_s));
    let message = format!(
        "joint \"{name}\" overshoots to {q} at {time}{where_}, between two points: its limits are {lower} and {upper}"
    );
    let error = Diagnostic::error(codes::scenario::PATH_LIMIT, message);
    Err(planning.place.mark(error.with_help("add a point where the spline overshoots, or change the times")))
}

/// Evaluates the spline at its knots and between them, until `keep_going` returns false.
fn look(spline: &JointSpline, dof: usize, mut keep_going: impl FnMut(f64, &SplineValues<'_>) -> bool) {
    let (mut q, mut first, mut second) = (vec![0.0; dof], vec![0.0; dof], vec![0.0; dof]);
    for pair in spline.knots().windows(2) {
        for part in 0..=BETWEEN_KNOTS {
            #[expect(clippy::cast_precision_loss, reason = "some 16")]
            let share = pair[0] + (pair[1] - pair[0]) * part as f64 / BETWEEN_KNOTS as f64;
            spline.at(share, SplineValues { q: &mut q, first: &mut first, second: &mut second });
            let values = SplineValues { q: &mut q, first: &mut first, second: &mut second };
            if !keep_going(share, &values) {
                return;
            }
        }
    }
}
