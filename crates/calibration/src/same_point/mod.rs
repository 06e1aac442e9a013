//! Calibration by one point: the tool of an arm touches a point that nobody has measured in many configurations, such as a ball in
//! a conical hole. The corrections make the tool points of each file coincide; no instrument is needed.
//!
//! What a point cannot say: where it is (so nothing of the base), how the tool is turned, and how large the arm is (one length is
//! held). Source: Ikits & Hollerbach, *Kinematic calibration using a plane constraint* (1997), with a point for the plane.

mod calibrate;
mod corrected;
mod points;
mod report;
mod undetermined;

pub use calibrate::{SamePointFile, SamePointOptions, calibrate_same_point};
pub use corrected::same_point_robot;
pub use report::{SamePointCorrection, SamePointReport, SamePointSpread, SamePointVerdict, TouchedPoint};
