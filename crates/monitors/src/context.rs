//! The inputs of checks before the first sample of a run.

use congruent_description::{JointKind, RobotDescription};

use crate::{ComparedPoses, RunClock, RunDynamics, RunPayload};

/// The inputs of checks before the first sample of a run.
#[derive(Debug)]
pub struct CheckContext<'a> {
    /// The robot with its model.
    pub description: &'a RobotDescription,
    /// The robot that its controllers know: of a robot whose values are uncertain that of the files.
    pub known: &'a RobotDescription,
    /// Clock and gravity of the run.
    pub clock: &'a RunClock,
    /// Bodies that links carry for a time.
    pub payloads: &'a [RunPayload],
    /// Whether the joint states were recorded or arrive: no simulation.
    pub is_recorded: bool,
    /// Joints that the source does not have: they stay at their start, and are not judged.
    pub held: &'a [String],
    /// Those of them that are between base and tip and might have moved: nothing of the tip is known without them.
    pub unknown: &'a [String],
    /// The poses that the source has of the robot.
    pub poses: &'a [ComparedPoses],
    /// The declared dynamics, with the payloads.
    pub dynamics: RunDynamics<'a>,
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
