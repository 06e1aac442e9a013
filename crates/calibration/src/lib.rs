//! Calibration: corrections of a robot's chain from measured poses or points of its tip, and which of them the
//! measurements do not identify.
//!
//! [`measurements`] reads files, [`estimation`] fits, [`report`] evaluates the estimates and describes them in sentences.
//! [`check_measured`] compares without fitting the arm.

mod calibrate;
mod chain;
pub mod codes;
mod computed;
pub mod estimation;
mod free;
mod measured_check;
pub mod measurements;
mod options;
pub mod report;

pub use calibrate::{calibrate, needed_coordinates};
pub use estimation::{Loss, Noise};
pub use free::GROUPS;
pub use measured_check::{
    FittedCorrection, MeasuredCheck, MeasuredCheckOptions, MeasuredDifference, MeasuredVerdict,
    check_measured,
};
pub use options::CalibrationOptions;
