//! `move_joints_*`: named joints move to absolute positions, the others hold.

use congruent_description::Diagnostic;

use super::{
    course::{Course, JointMove, Motion},
    planning::Planning,
};
use crate::{
    scenario::{JointMotion, mark},
    setup::JointTargets,
};

pub(super) fn plan(settings: &JointMotion, planning: &mut Planning<'_>) -> Result<Motion, Vec<Diagnostic>> {
    let robot = &planning.description.robot;
    let mut to = planning.from.clone();
    for target in JointTargets::from(settings).resolve(robot, planning.place)? {
        if let Some(message) = target.beyond_limits(robot, "target") {
            let warning = Diagnostic::warning("scenario::target_limit", message);
            planning.warnings.push(mark(warning, target.span.clone()));
        }
        target.put(robot, &mut to);
    }
    robot.apply_mimic(&mut to);
    let course = JointMove { from: planning.from.clone(), to, profile: settings.profile };
    Ok(Motion { duration_s: settings.duration_s, course: Course::Joints(course) })
}
