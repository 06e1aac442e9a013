//! Calibration: corrections of a robot's chain from measured poses or points of its tip, with what cannot be
//! known from them.
//!
//! [`measurements`] reads what was measured, [`estimation`] fits, [`report`] says what it means.

mod calibrate;
mod chain;
mod computed;
pub mod estimation;
mod free;
pub mod measurements;
mod options;
pub mod report;

pub use calibrate::{calibrate, needed_coordinates};
pub use estimation::{Loss, Noise};
pub use free::GROUPS;
pub use options::CalibrationOptions;
