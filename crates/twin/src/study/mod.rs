//! What an arm can do and what errors do to it: sensitivity, manipulability, workspace. The figures
//! are computed in `congruent-kinematics`; here they get names, units and plots.

pub mod manipulability;
pub mod sensitivity;
pub mod workspace;

use congruent_description::RobotDescription;
pub use congruent_kinematics::{Arm, KinematicsError, Sampling};

/// Names of the arm's joints.
fn joint_names(description: &RobotDescription, arm: &Arm) -> Vec<String> {
    arm.joints().iter().map(|joint| description.robot.joint(joint.joint).name.clone()).collect()
}
