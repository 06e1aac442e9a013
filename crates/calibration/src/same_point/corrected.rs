//! The robot with corrections from touched points.

use congruent_description::RobotDescription;
use congruent_input::Diagnostic;

use super::{
    calibrate::SamePointOptions,
    report::{SamePointReport, SamePointVerdict},
};
use crate::corrected::{CorrectedRobot, robot_with};

/// The robot of a description with the corrections of its calibration by points, with the same `options`; `None` if these are no better
/// than the nominal model, or cannot be verified.
///
/// # Errors
/// A joint of the URDF cannot move as the table says, or as [`calibrate_same_point`](super::calibrate_same_point).
pub fn same_point_robot(
    description: &RobotDescription,
    options: &SamePointOptions,
    report: &SamePointReport,
) -> Result<Option<CorrectedRobot>, Diagnostic> {
    if report.verdict != SamePointVerdict::Explained {
        return Ok(None);
    }
    let values = report.parameters.iter().map(|each| (each.name.as_str(), each.correction)).collect();
    robot_with(description, [&options.free, &options.hold], &values).map(Some)
}
