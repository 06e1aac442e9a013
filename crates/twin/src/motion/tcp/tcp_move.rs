//! `move_tcp`: the tool centre point goes to a pose in the world. The nearest solution of inverse
//! kinematics is taken and the joints go there together: the path in between is no straight line.

use congruent_description::{Diagnostic, RobotQ, display::length_and_angle};
use congruent_kinematics::{Arm, IkOptions, IkSolver, IkTarget, KinematicsError, Pose, TargetPart, UrdfTree};

use crate::{
    motion::{course::Motion, joints::joint_move::straight, planning::Planning},
    scenario::{FilePlace, PoseSettings, TcpMotion},
};

/// Random configurations from which other solutions are looked for: arms of six joints have up to 16.
const ATTEMPTS: usize = 64;

pub(in crate::motion) fn plan(
    settings: &TcpMotion,
    planning: &mut Planning<'_>,
) -> Result<Motion, Diagnostic> {
    let to = reach(&settings.move_tcp, planning)?;
    straight(to, (settings.profile, settings.duration_s), planning)
}

/// The arm that a tool's pose is asked of, and the pose in its base: all of it, or its position if no
/// rotation is given.
pub(super) fn target(
    (pose, place): (&PoseSettings, FilePlace<'_>),
    planning: &Planning<'_>,
) -> Result<(Arm, IkTarget), Diagnostic> {
    let part = if pose.has_rotation() { TargetPart::Pose } else { TargetPart::Position };
    let world_from_tcp = Pose::from(pose.target(place)?);
    let no_arm = |error| no_arm(&error, place);
    let description = planning.description;
    let tree = UrdfTree::new(&description.robot);
    let world_from_base = tree.root_from_link(planning.from, description.base).map_err(no_arm)?;
    let arm = Arm::of(description).map_err(no_arm)?;
    Ok((arm, IkTarget { base_from_tcp: world_from_base.inverse() * world_from_tcp, part }))
}

/// The configuration nearest to the motion's start that brings the tool there.
fn reach(pose: &PoseSettings, planning: &Planning<'_>) -> Result<RobotQ, Diagnostic> {
    let place = planning.place.key("move_tcp");
    let (arm, target) = target((pose, place), planning)?;
    let start = arm.from_robot(planning.from);
    let mut solver = IkSolver::new(arm);
    let found = solver.solve_nearest(&target, &start, &IkOptions::default(), ATTEMPTS);
    let found = found.map_err(|error| no_arm(&error, place))?;
    if !found.converged {
        let left = length_and_angle(found.residual_position_m, found.residual_orientation_rad);
        let message =
            format!("the tool cannot be brought there within the joint limits: {left} are left at best");
        let help = if pose.has_rotation() {
            "the pose is the tool centre point's in the world; leave the rotation out to ask for a position alone"
        } else {
            "the position is the tool centre point's in the world"
        };
        return Err(place.mark(Diagnostic::error("scenario::out_of_reach", message).with_help(help)));
    }
    let q = found.q.clone();
    let mut to = planning.from.clone();
    solver.arm().write_to_robot(&q, &mut to);
    planning.description.robot.apply_mimic(&mut to);
    Ok(to)
}

fn no_arm(error: &KinematicsError, place: FilePlace<'_>) -> Diagnostic {
    place.mark(Diagnostic::error("scenario::move_tcp", error.to_string()))
}
