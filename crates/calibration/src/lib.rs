//! Calibration: corrections of a robot's chain from measured poses or points of its tip, and which of them the
//! measurements do not identify.
//!
//! [`measurements`] reads files, [`estimation`] fits, [`report`] evaluates the estimates and describes them in sentences.
//! [`corrected_robot`] is the robot with the recommended corrections, [`check_measured`] compares without fitting the arm.

mod calibrate;
mod camera;
mod camera_frames;
mod chain;
pub mod codes;
mod computed;
mod corrected;
pub mod estimation;
mod free;
mod measured_check;
pub mod measurements;
mod options;
pub mod report;
pub mod same_point;

pub use calibrate::{calibrate, needed_coordinates};
pub use camera::{CAMERA_GROUPS, CameraMount};
pub use camera_frames::{CameraFrames, FrameOnLink, SharedMotion};
pub use corrected::{CorrectedRobot, corrected_robot};
pub use estimation::{Loss, Noise};
pub use free::GROUPS;
pub use measured_check::{
    FittedCorrection, MeasuredCheck, MeasuredCheckOptions, MeasuredDifference, MeasuredVerdict,
    check_measured,
};
pub use options::CalibrationOptions;
