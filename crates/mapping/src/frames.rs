//! The frames of the links of another description, moved to where a robot has them as far as the axes of both allow.

use congruent_description::{JointKind, LinkIndex, Robot};
use congruent_kinematics::ScrewTree;
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

/// Frames of links of one name that are turned by less are the same frame where axes differ: what differs is a difference. Kind: choice;
/// other frames of a link are quarter turns away.
const SAME_FRAME_RAD: f64 = 0.2;

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
/// an axis that lies elsewhere stays there, and then the frames of links that have one name, too.
#[must_use]
pub fn in_frames_of(
    robot: &Robot,
    other: &Robot,
    root_from_other_root: &Isometry3<f64>,
    axes: CommonAxes,
) -> Robot {
    let trees = [robot, other].map(ScrewTree::new);
    let home = |of: usize, link: LinkIndex| trees[of].home(link).to_isometry();
    let mut frames = vec![Isometry3::identity(); other.links().len()];
    frames[other.root().get()] = root_from_other_root.inverse();
    for joint in other.joints().iter().filter(|joint| joint.kind != JointKind::Fixed) {
        let Some(here) = robot.find_joint(&joint.name).map(|index| robot.joint(index)) else { continue };
        let link_from_frame = (root_from_other_root * home(1, joint.child)).inverse() * home(0, here.child);
        let is_same_link = robot.link(here.child).name == other.link(joint.child).name;
        if axes == CommonAxes::Differ && is_same_link && link_from_frame.rotation.angle() < SAME_FRAME_RAD {
            continue;
        }
        frames[joint.child.get()] = on_axis(&link_from_frame, &joint.axis_in_joint, &here.axis_in_joint);
    }
    other.with_link_frames(&frames)
}

/// The frame, turned so that the axis has the same coordinates as in the robot, with its origin on the axis.
fn on_axis(frame: &Isometry3<f64>, axis: &Vector3<f64>, axis_of_robot: &Vector3<f64>) -> Isometry3<f64> {
    let turned = UnitQuaternion::rotation_between(&(frame.rotation * axis_of_robot), axis)
        .unwrap_or_else(UnitQuaternion::identity);
    let along = axis * axis.dot(&frame.translation.vector);
    Isometry3::from_parts(Translation3::from(along), turned * frame.rotation)
}
