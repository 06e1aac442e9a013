//! Commands about models: compared, calibrated, derived and converted.

pub(crate) mod calibrate;
pub(crate) mod check;
pub(crate) mod convert;
pub(crate) mod derive;
pub(crate) mod describe;
mod errors_at;
mod fixed_table;
pub(crate) mod lint;
mod tolerance;
mod written_model;
