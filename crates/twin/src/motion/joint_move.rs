//! `move_joints_*`: named joints move to absolute positions, the others hold.

use congruent_description::{Diagnostic, RobotQ};

use super::{
    planning::Planning,
    trajectory::{Course, Motion},
};
use crate::{
    scenario::{JointMotion, Profile, Progress, mark},
    setup::JointTargets,
};

/// A planned move from one configuration to another.
#[derive(Debug, Clone, PartialEq)]
pub struct JointMove {
    /// Positions at its start.
    pub from: RobotQ,
    /// Positions at its end.
    pub to: RobotQ,
    /// How it runs in between.
    pub profile: Profile,
}

impl JointMove {
    /// Writes positions and velocities after a share of the move is done.
    pub(super) fn at(&self, progress: Progress, q: &mut RobotQ, qd: &mut [f64]) {
        for ((q, qd), (from, to)) in q.iter_mut().zip(qd).zip(self.from.iter().zip(&self.to)) {
            *q = from + (to - from) * progress.share;
            *qd = (to - from) * progress.share_per_s;
        }
    }
}

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
