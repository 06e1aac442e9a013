//! Analyses of one robot: summary of its description, forward and inverse kinematics, Jacobians, dynamics, conversion between
//! models, sensitivity, manipulability, workspace. The values are computed in `congruent-kinematics` and
//! `congruent-dynamics`; here they get names, units and figures.

mod arm_joints;
pub mod base_parameters;
pub mod codes;
pub mod conversion;
pub mod description_summary;
pub mod dynamics;
pub mod forward;
pub mod heat_map;
pub mod inverse;
pub mod jacobians;
mod largest_value;
pub mod manipulability;
pub mod plot;
pub mod sensitivity;
pub mod stream;
pub mod workspace;

pub use largest_value::largest_value;
