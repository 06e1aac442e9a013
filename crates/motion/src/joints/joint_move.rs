//! `move_joints_*`: named joints move to absolute positions, the others keep theirs.

use congruent_description::RobotQ;
use congruent_input::{Diagnostic, Findings};
use congruent_scenario::{JointMotion, Profile, mark};

use crate::{
    JointSpacePath, JointTargets, Motion, MotionPlan, PlannedMove, TimeScaling, codes,
    planning::{Planning, no_velocity_limit, nothing_moves},
    timing::least_time,
};

pub(crate) fn plan(settings: &JointMotion, planning: &mut Planning<'_>) -> Result<Motion, Findings> {
    let robot = &planning.description.robot;
    let mut to = planning.from.clone();
    let mut beyond = Vec::new();
    for target in JointTargets::from(settings).resolve(robot, planning.place)? {
        if let Some(message) = target.beyond_limits(robot, "target") {
            let warning = Diagnostic::warning(codes::scenario::TARGET_LIMIT, message);
            beyond.push(mark(warning, target.span.clone()));
        }
        target.put(robot, &mut to);
    }
    // After all targets, which may name a master later than its follower.
    robot.apply_mimic(&mut to);
    match straight(to, settings.profile, settings.duration_s, planning) {
        Ok(motion) => {
            planning.warnings.extend(beyond);
            Ok(motion)
        }
        // A target far beyond its limits is often the reason that the move is too fast, so it is reported first.
        Err(fault) => Err(beyond.into_iter().chain([fault]).collect()),
    }
}

/// A straight line in joint space from the start of the motion to `to`, over a duration or in the least time.
pub(crate) fn straight(
    to: RobotQ,
    profile: Profile,
    duration_s: Option<f64>,
    planning: &mut Planning<'_>,
) -> Result<Motion, Diagnostic> {
    let time_scaling = if let Some(duration_s) = duration_s {
        TimeScaling::Shape { profile, duration_s }
    } else {
        let change: Vec<f64> = planning.from.iter().zip(&to).map(|(from, to)| to - from).collect();
        let least = least_time(profile, &change, planning.limits);
        let least = least.map_err(|unlimited| no_velocity_limit(planning, unlimited))?;
        least.ok_or_else(|| nothing_moves(planning))?
    };
    let planned = PlannedMove {
        joint_path: JointSpacePath::Straight(planning.from.clone()),
        to,
        time_scaling,
        begins_s: 0.0,
    };
    let planned = planning.within_limits(planned, |_| String::new())?;
    Ok(Motion { duration_s: planned.time_scaling.duration_s(), motion_plan: MotionPlan::Planned(planned) })
}
