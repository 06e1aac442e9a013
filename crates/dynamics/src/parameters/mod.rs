//! Inertial parameters: the regressor, by which torques are linear in them, and which of them are identifiable.

mod base_parameters;
mod regressor;

pub use base_parameters::{BaseParameter, BaseParameters, InertialParameter};
