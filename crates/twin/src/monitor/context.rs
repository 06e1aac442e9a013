//! What checks know of a run before its first sample.

use congruent_description::{JointKind, RobotDescription};

use crate::setup::{DeclaredDynamics, Payload, RunClock};

/// What checks know of a run before its first sample.
#[derive(Debug)]
pub struct CheckContext<'a> {
    /// The robot with its model.
    pub description: &'a RobotDescription,
    /// Clock and gravity.
    pub clock: &'a RunClock,
    /// What links carry for a time.
    pub payloads: &'a [Payload],
    /// The declared dynamics, with the payloads.
    pub dynamics: DeclaredDynamics<'a>,
}

impl CheckContext<'_> {
    /// Number of movable joints.
    pub(super) fn dof(&self) -> usize {
        self.description.robot.dof()
    }

    /// How each movable joint moves.
    pub(super) fn joint_kinds(&self) -> Vec<JointKind> {
        let robot = &self.description.robot;
        robot.movable_joints().iter().map(|&joint| robot.joint(joint).kind).collect()
    }
}
