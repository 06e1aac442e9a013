//! `move_tcp`: the tool centre point goes to a pose in the world. The nearest solution of inverse
//! kinematics is taken and the joints go there together: the path in between is no straight line.

use congruent_description::{Diagnostic, RobotQ, WrittenTransform};
use congruent_kinematics::{Arm, IkOptions, IkSolver, IkTarget, KinematicsError, Pose, TargetPart, UrdfTree};
use serde::Deserialize;
use toml::Spanned;

use super::{Context, Course, JointMove, Motion, Profile};
use crate::scenario::{Positive, Section};

/// The keys that make a section this kind of motion.
pub(super) const KEYS: &[&str] = &["move_tcp"];
/// Random configurations from which other solutions are looked for: arms of six joints have up to 16.
const ATTEMPTS: usize = 64;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    move_tcp: Spanned<WrittenTransform>,
    duration_s: Positive,
    #[serde(default)]
    profile: Profile,
}

pub(super) fn parse(section: Section<'_>, context: &mut Context<'_>) -> Result<Motion, Vec<Diagnostic>> {
    let written: Written = section.read()?;
    let to = reach(&written.move_tcp, context).map_err(|error| vec![error])?;
    let course = JointMove { from: context.from.clone(), to, profile: written.profile };
    Ok(Motion { duration_s: written.duration_s.get(), course: Course::Joints(course) })
}

/// The arm that a tool's pose is asked of, and the pose in its base: all of it, or its position where
/// no rotation is written.
pub(super) fn target(
    written: &Spanned<WrittenTransform>,
    context: &Context<'_>,
) -> Result<(Arm, IkTarget), Diagnostic> {
    let span = written.span();
    let transform = written.get_ref();
    let part = if transform.has_rotation() { TargetPart::Pose } else { TargetPart::Position };
    let world_from_tcp = Pose::from(transform.isometry().map_err(|error| in_span(error, &span))?);
    let no_arm = |error| no_arm(&error, &span);
    let world_from_base = UrdfTree::new(context.robot)
        .root_from_link(context.from, context.description.base)
        .map_err(no_arm)?;
    let arm = Arm::of(context.description).map_err(no_arm)?;
    Ok((arm, IkTarget { base_from_tcp: world_from_base.inverse() * world_from_tcp, part }))
}

/// The configuration nearest to the motion's start that brings the tool there.
fn reach(written: &Spanned<WrittenTransform>, context: &Context<'_>) -> Result<RobotQ, Diagnostic> {
    let span = written.span();
    let (arm, target) = target(written, context)?;
    let start = arm.from_robot(context.from);
    let mut solver = IkSolver::new(arm);
    let found = solver.solve_nearest(&target, &start, &IkOptions::default(), ATTEMPTS);
    let found = found.map_err(|error| no_arm(&error, &span))?;
    if !found.converged {
        let message = format!(
            "the tool cannot be brought there within the joint limits: {:.4} mm and {:.4} deg are left at best",
            found.residual_position_m * 1e3,
            found.residual_orientation_rad.to_degrees()
        );
        return Err(Diagnostic::error("scenario::out_of_reach", message)
            .with_help("the pose is the tool centre point's in the world; leave the rotation out to ask for a position alone")
            .at(span.clone()));
    }
    let q = found.q.clone();
    let mut to = context.from.clone();
    solver.arm().write_to_robot(&q, &mut to);
    context.robot.apply_mimic(&mut to);
    Ok(to)
}

fn no_arm(error: &KinematicsError, span: &std::ops::Range<usize>) -> Diagnostic {
    Diagnostic::error("scenario::move_tcp", error.to_string()).at(span.clone())
}

fn in_span(mut error: Diagnostic, span: &std::ops::Range<usize>) -> Diagnostic {
    error.span.get_or_insert_with(|| span.clone());
    error
}
