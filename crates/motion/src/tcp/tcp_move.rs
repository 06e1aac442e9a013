//! `move_tcp`: the tool centre point moves to a pose in the world. The nearest solution of inverse
//! kinematics is taken and all joints move there together: the path of the tool is not a straight line.

use congruent_description::RobotQ;
use congruent_input::{Diagnostic, display::length_and_angle};
use congruent_kinematics::{Arm, IkOptions, IkSolver, IkTarget, KinematicsError, Pose, TargetPart, UrdfTree};
use congruent_scenario::{FilePlace, PoseSettings, TcpMotion};

use crate::{Motion, codes, joints::joint_move::straight, planning::Planning};

/// Random start configurations of the search for other solutions: arms of six joints have up to 16.
const ATTEMPTS: usize = 64;

pub(crate) fn plan(settings: &TcpMotion, planning: &mut Planning<'_>) -> Result<Motion, Diagnostic> {
    let to = reach(&settings.move_tcp, planning)?;
    straight(to, settings.profile, settings.duration_s, planning)
}

/// The arm that moves the tool, and the target in its base frame: a pose, or a position if no rotation is given.
pub(super) fn target(
    pose: &PoseSettings,
    place: FilePlace<'_>,
    planning: &Planning<'_>,
) -> Result<(Arm, IkTarget), Diagnostic> {
    let part = if pose.has_rotation() { TargetPart::Pose } else { TargetPart::Position };
    let world_from_tcp = Pose::from(pose.target(place)?);
    let no_arm = |error| no_arm(&error, place);
    let description = planning.description;
    let tree = UrdfTree::new(&description.robot);
    // At the start of the motion: joints before the base do not move with it.
    let world_from_base = tree.root_from_link(planning.from, description.base).map_err(no_arm)?;
    let arm = Arm::from_description(description).map_err(no_arm)?;
    Ok((arm, IkTarget { base_from_tcp: world_from_base.inverse() * world_from_tcp, part }))
}

/// The solution of inverse kinematics that is nearest to the start of the motion.
fn reach(pose: &PoseSettings, planning: &Planning<'_>) -> Result<RobotQ, Diagnostic> {
    let place = planning.place.key("move_tcp");
    let (arm, target) = target(pose, place, planning)?;
    let start = arm.from_robot(planning.from);
    let mut solver = IkSolver::new(arm);
    // Nearest of several solutions: the first one found may turn a wrist by a whole turn.
    let found = solver.solve_nearest(&target, &start, &IkOptions::default(), ATTEMPTS);
    let found = found.map_err(|error| no_arm(&error, place))?;
    if !found.converged {
        let smallest_error = length_and_angle(found.residual_position_m, found.residual_orientation_rad);
        let message =
            format!("the target is out of reach within the joint limits: smallest error {smallest_error}");
        let help = if pose.has_rotation() {
            "the target is the pose of the tool centre point in the world; without a rotation, only the position counts"
        } else {
            "the target is the position of the tool centre point in the world"
        };
        return Err(place.mark(Diagnostic::error(codes::scenario::OUT_OF_REACH, message).with_help(help)));
    }
    let q = found.q.clone();
    // Joints outside the arm keep their positions.
    let mut to = planning.from.clone();
    solver.arm().write_to_robot(&q, &mut to);
    planning.description.robot.apply_mimic(&mut to);
    Ok(to)
}

fn no_arm(error: &KinematicsError, place: FilePlace<'_>) -> Diagnostic {
    place.mark(Diagnostic::error(codes::scenario::MOVE_TCP, error.to_string()))
}
