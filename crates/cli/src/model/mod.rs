//! Commands about models: compared, calibrated, derived and converted.

pub(crate) mod calibrate;
pub(crate) mod check;
mod check_text;
pub(crate) mod convert;
pub(crate) mod derive;
pub(crate) mod describe;
mod diagnosis_text;
mod dynamics_text;
mod errors_at;
pub(crate) mod lint;
mod tolerance;
mod written_model;
