//! Commands about models: compared, calibrated and converted.

pub(crate) mod calibrate;
mod calibrated_robot;
mod camera;
pub(crate) mod check;
pub(crate) mod convert;
pub(crate) mod describe;
mod errors_at;
mod fixed_table;
pub(crate) mod identify;
pub(crate) mod lint;
mod measured;
pub(crate) mod plan;
mod same_point;
mod split_values;
mod written_model;
