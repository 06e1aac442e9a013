//! One displacement of all that a joint carries, found from the screws and the tip alone: for descriptions whose
//! link frames lie elsewhere in their links, which no motion shows.
//!
//! A displacement `D` (in the root's frame, at zero) of all behind a joint changes the screws there to `Ad(D) S`
//! and the tip to `D M`, and nothing before it. So the tip gives `D`, and the screws show at which joints it may
//! be.
//!
//! Source: Lynch & Park, *Modern Robotics* (2017), eq. 3.83 and 4.14.

use congruent_description::{Joint, JointIndex, JointKind, LinkIndex, Robot, Tolerance};
use congruent_kinematics::{Pose, PoseError, Twist};
use nalgebra::Vector3;

use crate::MatchedRobots;

use super::{
    compared_at::ComparedAt,
    correction::{JointCorrection, JointPart},
};

/// Whether all joints move alike, and the last links and the tip are where they are in the other description: then only
/// frames of links between differ, which is no other robot.
pub(super) fn moves_alike(robots: &MatchedRobots<'_>, at: &ComparedAt<'_>) -> bool {
    let robot = robots.robot;
    let is_last =
        |link: &LinkIndex| *link == at.tip || robot.joints().iter().all(|joint| joint.parent != *link);
    let is_same = |link| PoseError::between(&robots.own(link), &robots.there(link)).is_within(at.tolerance);
    explains(robots, &Pose::identity(), None, at.tolerance)
        && robot.link_indices().filter(is_last).filter(|&link| robots.is_matched(link)).all(is_same)
}

/// The joints between base and tip of which one other origin brings all screws and the tip into agreement; first those
/// that have this origin in the other description.
pub(super) fn displaced(robots: &MatchedRobots<'_>, at: &ComparedAt<'_>) -> Vec<JointCorrection> {
    let off = |link| robots.own(link) * robots.there(link).inverse();
    let base = PoseError::between(&robots.own(at.base), &robots.there(at.base));
    if !robots.is_matched(at.tip) || !base.is_within(at.tolerance) {
        return Vec::new();
    }
    // `D = M M'^-1`: the tip of both at zero, in the root's frame.
    let displacement = off(at.tip);
    let mut places: Vec<(bool, JointCorrection)> = Vec::new();
    for index in path(robots.robot, at) {
        let joint = robots.robot.joint(index);
        if explains(robots, &displacement, Some(joint), at.tolerance) {
            let parent = robots.own(joint.parent);
            // `D^-1` in the frame of the parent link, in which an origin is written.
            let undone = parent.inverse() * displacement.inverse() * parent;
            let expected = undone * Pose::from(joint.parent_from_joint);
            let is_there = robots.namesake(joint).is_some_and(|there| {
                PoseError::between(&expected, &there.parent_from_joint.into()).is_within(at.tolerance)
            });
            let size_m = displacement.translation.norm();
            let part = JointPart::Origin(expected.to_isometry());
            places.push((is_there, JointCorrection { joint: index, expected: part, size_m }));
        }
    }
    // Stable: among those that are not in the other file the order from base to tip remains.
    places.sort_by_key(|(is_there, _)| !is_there);
    places.into_iter().map(|(_, correction)| correction).collect()
}

/// The joints from base to tip.
fn path(robot: &Robot, at: &ComparedAt<'_>) -> Vec<JointIndex> {
    let mut joints = Vec::new();
    let mut link = at.tip;
    while let Some(joint) = robot.parent_joint(link).filter(|_| link != at.base) {
        joints.push(joint);
        link = robot.joint(joint).parent;
    }
    joints.reverse();
    joints
}

/// Whether all screws agree if everything from `displaced` on is displaced.
fn explains(
    robots: &MatchedRobots<'_>,
    displacement: &Pose,
    displaced: Option<&Joint>,
    tolerance: &Tolerance,
) -> bool {
    let robot = robots.robot;
    // Parents come before children.
    let mut is_behind = vec![false; robot.links().len()];
    robot.joints().iter().all(|joint| {
        let behind = is_behind[joint.parent.get()] || displaced.is_some_and(|of| of.child == joint.child);
        is_behind[joint.child.get()] = behind;
        let Some(there) = robots.namesake(joint).filter(|_| joint.kind.is_movable()) else { return true };
        let found = screw(joint, &robots.own(joint.child));
        let expected = screw(there, &robots.there(joint.child));
        let expected = if behind { expected.transformed_by(displacement) } else { expected };
        (found.angular - expected.angular).norm() <= tolerance.orientation_rad
            && (found.linear - expected.linear).norm() <= tolerance.position_m
    })
}

/// The screw of a moving joint in the root's frame.
fn screw(joint: &Joint, root_from_child: &Pose) -> Twist {
    let axis = joint.axis_in_joint.into_inner();
    let in_joint = match joint.kind {
        JointKind::Prismatic => Twist { angular: Vector3::zeros(), linear: axis },
        _ => Twist { angular: axis, linear: Vector3::zeros() },
    };
    in_joint.transformed_by(root_from_child)
}
