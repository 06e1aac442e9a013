//! What a calibration says: estimates, what is frozen, what does not fit, where to measure next.

pub(crate) mod assemble;
pub(crate) mod content;
pub mod plot;
mod reading;
mod statements;
mod yardstick;

pub use content::{
    CalibrationReport, CostCurve, Estimate, Estimation, Explanation, FrozenParameter, HeldOutError,
    Identifiability, LikelyReason, NextPose, Recommendation, Remainder, RowResidual, TableEntry,
};
