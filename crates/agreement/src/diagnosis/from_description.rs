//! The candidate and the reference model from a robot description.

use congruent_description::{DhTable, JointIndex, JointKind, LinkIndex, Robot};
use congruent_kinematics::Twist;
use nalgebra::Vector3;

use super::{
    candidate::{CandidateModel, CandidateRow},
    reference_model::{ReferenceJoint, ReferenceModel},
};

impl CandidateModel {
    /// The candidate of a table; its rows are driven by `joints`, the moving joints of the reference model
    /// from base to tip. `None` when a row names another joint.
    pub fn from_table(table: &DhTable, joints: &[JointIndex]) -> Option<Self> {
        let row = |row: &congruent_description::DhRow| {
            let joint = joints.iter().position(|joint| *joint == row.joint)?;
            Some(CandidateRow::from_dh_row(joint, row))
        };
        Some(Self {
            convention: Some(table.convention),
            base: congruent_kinematics::Pose::from(table.base_from_dh0).into(),
            rows: table.rows.iter().map(row).collect::<Option<_>>()?,
            tool: congruent_kinematics::Pose::from(table.dhn_from_tip).into(),
        })
    }
}

impl ReferenceModel {
    /// The chain of a robot from link `base` to link `tip`, with its joints, fixed ones included. `None` if
    /// `tip` is not a descendant of the body of `base`.
    pub fn from_urdf(robot: &Robot, base: LinkIndex, tip: LinkIndex) -> Option<(Self, Vec<JointIndex>)> {
        let (mut up, mut down) = (path_to_root(robot, base), path_to_root(robot, tip));
        // Both paths end at the root. What they share is no part of the chain from base to tip.
        while up.last().is_some() && up.last() == down.last() {
            up.pop();
            down.pop();
        }
        // A moving joint on the side of the base would be passed against its direction, which a table cannot say.
        if up.iter().any(|&joint| robot.joint(joint).kind.is_movable()) {
            return None;
        }
        let upward =
            up.iter().map(|&joint| ReferenceJoint { is_upward: true, ..reference_joint(robot, joint) });
        let downward = down.iter().rev().map(|&joint| reference_joint(robot, joint));
        let joints = upward.chain(downward).collect();
        down.reverse();
        Some((Self { joints }, [up, down].concat()))
    }
}

/// The joints between a link and the root, the nearest first.
fn path_to_root(robot: &Robot, mut link: LinkIndex) -> Vec<JointIndex> {
    let mut path = Vec::new();
    while let Some(joint) = robot.parent_joint(link) {
        path.push(joint);
        link = robot.joint(joint).parent;
    }
    path
}

fn reference_joint(robot: &Robot, joint: JointIndex) -> ReferenceJoint {
    let joint = robot.joint(joint);
    let axis = joint.axis_in_joint.into_inner();
    let twist_in_joint = match joint.kind {
        JointKind::Fixed => None,
        JointKind::Prismatic => Some(Twist { angular: Vector3::zeros(), linear: axis }),
        JointKind::Revolute | JointKind::Continuous => {
            Some(Twist { angular: axis, linear: Vector3::zeros() })
        }
    };
    let parent_from_joint = joint.parent_from_joint.into();
    ReferenceJoint { parent_from_joint, twist_in_joint, is_upward: false, is_written: true }
}
