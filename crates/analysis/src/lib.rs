//! What a robot is, and what an arm can do: its description in short, forward and inverse kinematics, Jacobians, one model written as another, sensitivity,
//! manipulability, workspace. The values are computed in `congruent-kinematics`; here they get names, units
//! and plots.

mod arm_joints;
pub mod base_parameters;
pub mod conversion;
pub mod description_summary;
pub mod dynamics;
pub mod forward;
pub mod inverse;
pub mod jacobians;
pub mod manipulability;
pub mod plot;
pub mod sensitivity;
pub mod stream;
pub mod workspace;
