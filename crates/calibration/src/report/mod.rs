//! What a calibration says: estimates, what is fixed, what does not fit, where to measure next.

pub(crate) mod assemble;
pub(crate) mod content;
pub mod plot;
mod reach_scale;
mod reading;
mod statements;

pub use content::{
    CalibrationReport, CalibrationVerdict, CostCurve, Estimate, Estimation, HeldOutError, Identifiability,
    LikelyReason, NextPose, Recommendation, Remainder, ReportedFixedParameter, RowResidual, TableEntry,
};
