//! `move_joints_*`: named joints move to absolute positions, the others hold.

use congruent_description::{Diagnostic, RobotQ};

use crate::{
    motion::{
        course::{Course, Motion, PlannedMove, Way},
        planning::{Planning, no_velocity_limit, nothing_moves},
        timing::{Pace, least_time},
    },
    scenario::{JointMotion, Profile, mark},
    setup::JointTargets,
};

pub(in crate::motion) fn plan(
    settings: &JointMotion,
    planning: &mut Planning<'_>,
) -> Result<Motion, Vec<Diagnostic>> {
    let robot = &planning.description.robot;
    let mut to = planning.from.clone();
    let mut beyond = Vec::new();
    for target in JointTargets::from(settings).resolve(robot, planning.place)? {
        if let Some(message) = target.beyond_limits(robot, "target") {
            let warning = Diagnostic::warning("scenario::target_limit", message);
            beyond.push(mark(warning, target.span.clone()));
        }
        target.put(robot, &mut to);
    }
    robot.apply_mimic(&mut to);
    match straight(to, (settings.profile, settings.duration_s), planning) {
        Ok(motion) => {
            planning.warnings.extend(beyond);
            Ok(motion)
        }
        // A target that is far too far is why the move is too fast: it is told first.
        Err(fault) => Err(beyond.into_iter().chain([fault]).collect()),
    }
}

/// All joints together from where they stand to `to`, over a duration or in the least time.
pub(in crate::motion) fn straight(
    to: RobotQ,
    (profile, duration_s): (Profile, Option<f64>),
    planning: &mut Planning<'_>,
) -> Result<Motion, Diagnostic> {
    let pace = if let Some(duration_s) = duration_s {
        Pace::Shape { profile, duration_s }
    } else {
        let change: Vec<f64> = planning.from.iter().zip(&to).map(|(from, to)| to - from).collect();
        let least = least_time(profile, &change, planning.limits);
        let least = least.map_err(|unlimited| no_velocity_limit(planning, unlimited))?;
        least.ok_or_else(|| nothing_moves(planning))?
    };
    let planned = PlannedMove { way: Way::Straight(planning.from.clone()), to, pace, begins_s: 0.0 };
    let planned = planning.within_limits(planned, |_| String::new())?;
    Ok(Motion { duration_s: planned.pace.duration_s(), course: Course::Planned(planned) })
}
