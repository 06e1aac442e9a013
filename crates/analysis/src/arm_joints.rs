//! The joints of an arm by their names.

use congruent_description::RobotDescription;
use congruent_kinematics::Arm;

/// Names of the arm's independent joints, base to tip.
pub(crate) fn joint_names(description: &RobotDescription, arm: &Arm) -> Vec<String> {
    arm.joints().iter().map(|joint| description.robot.joint(joint.joint).name.clone()).collect()
}
