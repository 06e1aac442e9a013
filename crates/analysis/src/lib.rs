//! What an arm can do: forward and inverse kinematics, Jacobians, one model written as another, sensitivity,
//! manipulability, workspace. The values are computed in `congruent-kinematics`; here they get names, units
//! and plots.

pub mod conversion;
pub mod forward;
pub mod inverse;
pub mod jacobians;
pub mod manipulability;
pub mod plot;
pub mod sensitivity;
pub mod workspace;

use congruent_description::RobotDescription;
use congruent_kinematics::Arm;

/// Names of the arm's joints.
fn joint_names(description: &RobotDescription, arm: &Arm) -> Vec<String> {
    arm.joints().iter().map(|joint| description.robot.joint(joint.joint).name.clone()).collect()
}
