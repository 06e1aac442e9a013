//! What is fitted: measurements with their noise, and the normal equations of a corrected chain on them.

mod configurations;
mod measurement;
mod noise;
mod normal_equations;

pub use configurations::configurations;
pub use measurement::{Measurement, PoseResidual};
pub use noise::Noise;
pub use normal_equations::Problem;

pub(super) use noise::{median_norm, outlying_norm};
pub(super) use normal_equations::{CalibrationEquations, Linearisation, Weighting};
