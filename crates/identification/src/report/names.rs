//! Names and units of what was identified.

use congruent_description::{JointKind, Robot};

use crate::unknowns::JointUnknown;

pub(super) fn name(robot: &Robot, joint: usize) -> String {
    robot.joint(robot.movable_joints()[joint]).name.clone()
}

pub(super) fn link_name(robot: &Robot, joint: usize) -> String {
    robot.link(robot.joint(robot.movable_joints()[joint]).child).name.clone()
}

pub(super) fn kind(robot: &Robot, joint: usize) -> JointKind {
    robot.joint(robot.movable_joints()[joint]).kind
}

/// The unit of a term of a joint.
pub fn term_unit(term: JointUnknown, kind: JointKind) -> &'static str {
    match (term, kind.is_angular()) {
        (JointUnknown::Viscous, true) => "N m s/rad",
        (JointUnknown::Viscous, false) => "N s/m",
        (JointUnknown::Coulomb | JointUnknown::Offset, true) => "N m",
        (JointUnknown::Coulomb | JointUnknown::Offset, false) => "N",
        (JointUnknown::Armature, true) => "kg m^2",
        (JointUnknown::Armature, false) => "kg",
    }
}
