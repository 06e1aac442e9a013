//! The report of a calibration: estimates, what is fixed, residuals, suggested measurements, sentences, plot.

pub(crate) mod assemble;
mod calibrated_files;
mod calibration_report;
mod fixed;
mod frames;
mod interpretation;
pub mod plot;
mod residual_size;
pub(crate) mod residual_summary;
mod statements;
mod target_scale;
mod verdict;

pub use calibrated_files::{CalibratedFiles, WrittenModel};
pub use calibration_report::{
    AlignedFrames, CalibratedModel, CalibrationReport, CalibrationVerdict, CorrectedTableEntry, CostCurve,
    EstimatedCorrection, FitSummary, HeldOutSummary, Identifiability, LikelyReason, Recommendation,
    ReportedFixedParameter, ResidualSummary, RowEntry, RowResidual, SuggestedConfiguration,
};
pub(crate) use fixed::reported_fixed;
pub use frames::EstimatedFrames;
