//! `move_joints_*`: named joints move to absolute positions, the others hold.

use congruent_description::Diagnostic;
use serde::Deserialize;

use super::{Context, Course, JointMove, Motion, Profile};
use crate::scenario::{JointValues, Positive, Section, WrittenJoints};

/// The keys that make a section this kind of motion.
pub(super) const KEYS: &[&str] = &["move_joints_deg", "move_joints_rad", "move_joints_m", "move_joints_mm"];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    #[serde(default)]
    move_joints_deg: WrittenJoints,
    #[serde(default)]
    move_joints_rad: WrittenJoints,
    #[serde(default)]
    move_joints_m: WrittenJoints,
    #[serde(default)]
    move_joints_mm: WrittenJoints,
    duration_s: Positive,
    #[serde(default)]
    profile: Profile,
}

pub(super) fn parse(section: Section<'_>, context: &mut Context<'_>) -> Result<Motion, Vec<Diagnostic>> {
    let written: Written = section.read()?;
    let targets = JointValues {
        deg: written.move_joints_deg,
        rad: written.move_joints_rad,
        m: written.move_joints_m,
        mm: written.move_joints_mm,
    }
    .resolve(context.robot)?;
    let mut to = context.from.clone();
    for target in targets {
        if let Some(message) = target.beyond_limits(context.robot, "target") {
            context.warnings.push(Diagnostic::warning("scenario::target_limit", message).at(target.span));
        }
        let coordinate = context.robot.coordinate(target.joint).expect("resolved joints move");
        to[coordinate] = target.value;
    }
    context.robot.apply_mimic(&mut to);
    let course = JointMove { from: context.from.clone(), to, profile: written.profile };
    Ok(Motion { duration_s: written.duration_s.get(), course: Course::Joints(course) })
}
