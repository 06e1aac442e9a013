//! Inertial parameters: the regressor, in which torques are linear in them, and what torques tell of them.

mod base_parameters;
mod regressor;

pub use base_parameters::{BaseParameter, BaseParameters, InertialParameter};
