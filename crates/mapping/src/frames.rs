//! The frames of the links of another description, moved to where a robot has them as far as the axes of both allow.

use std::collections::BTreeSet;

use congruent_description::{Joint, JointKind, LinkIndex, Robot};
use congruent_kinematics::ScrewTree;
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use crate::digits::along_axis;

/// Frames of links of one name that are turned by less are the same frame where axes differ: what differs is a difference. Kind: choice;
/// other frames of a link are quarter turns away.
const SAME_FRAME_RAD: f64 = 0.2;

/// Frames that are nearer are at one place in their link. Unit: rad and m; kind: choice, beyond what files of one robot differ in.
const SAME_PLACE: f64 = 3e-3;

/// Whether the axes of two descriptions are the same in the same variables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CommonAxes {
    /// They are: a frame that lies elsewhere in its link is another choice of frame.
    Agree,
    /// One of them lies elsewhere: which frame differs shows where.
    Differ,
}

/// The other description with its root and the links of its moving joints in the frames of `robot`: it has the same moving
/// joints by name, in the same variables. A frame is turned and shifted along the axis of its joint, which changes no motion;
/// an axis that lies elsewhere stays there, and then the frames of links that have one name, too. Joints that are `misplaced`, by name,
/// keep their frames: what differs there is a difference.
#[must_use]
pub fn in_frames_of(
    [robot, other]: [&Robot; 2],
    named_tip: Option<LinkIndex>,
    root_from_other_root: &Isometry3<f64>,
    axes: CommonAxes,
    misplaced: &BTreeSet<&str>,
) -> Robot {
    let mut frames = vec![Isometry3::identity(); other.links().len()];
    frames[other.root().get()] = root_from_other_root.inverse();
    for JointFrames { joint, here, link_from_frame, is_same_link } in
        joint_frames([robot, other], root_from_other_root)
    {
        // The frame of a tip that is named, or at the end of a branch, shows the zero of its joint if both files call the link the
        // same and place its frame alike.
        let is_evidence = named_tip == Some(here.child) || is_end(robot, here.child);
        if misplaced.contains(joint.name.as_str())
            || (is_same_link && is_evidence && is_along_axis(joint, &link_from_frame, here))
        {
            continue;
        }
        if axes == CommonAxes::Differ && is_same_link && link_from_frame.rotation.angle() < SAME_FRAME_RAD {
            continue;
        }
        frames[joint.child.get()] = on_axis(&link_from_frame, &joint.axis_in_joint, &here.axis_in_joint);
    }
    let moved = other.with_link_frames(&frames);
    if axes == CommonAxes::Differ {
        return moved;
    }
    // No digits bind a frame that was chosen here.
    let is_chosen =
        |joint: &Joint| joint.kind != JointKind::Fixed && frames[joint.child.get()] != Isometry3::identity();
    let chosen: BTreeSet<&str> =
        other.joints().iter().filter(|joint| is_chosen(joint)).map(|joint| joint.name.as_str()).collect();
    moved.with_joints(|joint| {
        if chosen.contains(joint.name.as_str()) {
            let [shift, turn] = along_axis(joint);
            joint.rounding.frame.extend([shift, turn]);
        }
    })
}

/// The last link of a branch, with another frame in each of two descriptions.
#[derive(Debug, Clone, PartialEq)]
pub struct EndInOtherFrames {
    /// The link, which has one name in both.
    pub link: LinkIndex,
    /// How far the origins of both frames are apart along the axis of its joint, m.
    pub along_axis_m: f64,
}

/// The last links of branches that both descriptions name alike and whose axes they write in other coordinates: [`in_frames_of`] takes
/// their frames as chosen, so that a length along the axis is not compared there.
pub fn ends_in_other_frames(
    [robot, other]: [&Robot; 2],
    root_from_other_root: &Isometry3<f64>,
) -> Vec<EndInOtherFrames> {
    let frames = joint_frames([robot, other], root_from_other_root).into_iter();
    let is_other = |of: &JointFrames<'_>| {
        of.is_same_link
            && is_end(robot, of.here.child)
            && !is_along_axis(of.joint, &of.link_from_frame, of.here)
    };
    let end = |of: JointFrames<'_>| EndInOtherFrames {
        link: of.here.child,
        along_axis_m: of.joint.axis_in_joint.dot(&of.link_from_frame.translation.vector).abs(),
    };
    frames.filter(is_other).map(end).collect()
}

/// Whether a link of one name has a frame that lies elsewhere in it: with the same axis in other coordinates, or farther than `least_m`
/// from where the robot has it, which is more than the axes of both are apart.
pub fn has_other_frames(
    [robot, other]: [&Robot; 2],
    root_from_other_root: &Isometry3<f64>,
    least_m: f64,
) -> bool {
    joint_frames([robot, other], root_from_other_root).into_iter().any(|of| {
        let has_other_axis = of.joint.axis_in_joint.angle(&of.here.axis_in_joint) > SAME_FRAME_RAD;
        of.is_same_link && (has_other_axis || of.link_from_frame.translation.vector.norm() > least_m)
    })
}

/// A moving joint of the other description, and the joint of its name.
struct JointFrames<'a> {
    joint: &'a Joint,
    here: &'a Joint,
    /// Where the robot has the frame of the link, in the link of the other.
    link_from_frame: Isometry3<f64>,
    /// Whether both files call the link the same.
    is_same_link: bool,
}

fn joint_frames<'a>(
    [robot, other]: [&'a Robot; 2],
    root_from_other_root: &Isometry3<f64>,
) -> Vec<JointFrames<'a>> {
    let trees = [robot, other].map(ScrewTree::new);
    let home = |of: usize, link: LinkIndex| trees[of].home(link).to_isometry();
    let of_both = |joint: &'a Joint| {
        let here = robot.joint(robot.find_joint(&joint.name)?);
        Some(JointFrames {
            joint,
            here,
            link_from_frame: (root_from_other_root * home(1, joint.child)).inverse() * home(0, here.child),
            is_same_link: robot.link(here.child).name == other.link(joint.child).name,
        })
    };
    other.joints().iter().filter(|joint| joint.kind.is_movable()).filter_map(of_both).collect()
}

/// Whether the frames of a link differ by a shift alone if it slides, or else by a turn about the axis of its joint and a shift along
/// it: then both have the axis in the same coordinates.
fn is_along_axis(joint: &Joint, link_from_frame: &Isometry3<f64>, here: &Joint) -> bool {
    if joint.kind == JointKind::Prismatic {
        return link_from_frame.rotation.angle() < SAME_PLACE;
    }
    let axis = joint.axis_in_joint.into_inner();
    let [own, moved] = [axis, link_from_frame.rotation * axis].map(|of| of - here.axis_in_joint.into_inner());
    let is_same_axis = own.norm() < SAME_PLACE && moved.norm() < SAME_PLACE;
    is_same_axis && link_from_frame.translation.vector.cross(&axis).norm() < SAME_PLACE
}

/// Whether no joint moves anything behind a link.
fn is_end(robot: &Robot, link: LinkIndex) -> bool {
    let is_moved =
        |joint: &Joint| joint.kind != JointKind::Fixed && robot.body(joint.parent) == robot.body(link);
    !robot.joints().iter().any(is_moved)
}

/// The frame, turned so that the axis has the same coordinates as in the robot, with its origin on the axis.
fn on_axis(frame: &Isometry3<f64>, axis: &Vector3<f64>, axis_of_robot: &Vector3<f64>) -> Isometry3<f64> {
    let turned = UnitQuaternion::rotation_between(&(frame.rotation * axis_of_robot), axis)
        .unwrap_or_else(UnitQuaternion::identity);
    let along = axis * axis.dot(&frame.translation.vector);
    Isometry3::from_parts(Translation3::from(along), turned * frame.rotation)
}
