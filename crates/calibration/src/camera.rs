//! A camera that sees a target: where it is mounted, and which rows of measurements it can have.

use std::fmt;

use congruent_description::RobotDescription;
use congruent_input::Diagnostic;
use congruent_kinematics::Pose;
use nalgebra::{Matrix3, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{codes, measurements::MeasuredRow};

/// Where the camera is that measured the rows. Each row is the pose, or the point, of a target in the frame of the camera,
/// `camera_from_target`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CameraMount {
    /// The camera is mounted on link `tip` and sees a target that is fixed to link `base`.
    EyeInHand,
    /// The camera is beside the robot, fixed to link `base`, and sees a target on link `tip`.
    EyeToHand,
}

impl fmt::Display for CameraMount {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(formatter)
    }
}

/// The groups of corrections that are the poses of camera and target.
pub const CAMERA_GROUPS: [&str; 2] = ["base", "tool"];

/// The name of what was measured.
pub(crate) fn measured_frame(description: &RobotDescription, camera: Option<CameraMount>) -> String {
    match (camera, description.tip_from_tcp) {
        (Some(_), _) => "target".to_owned(),
        (None, Some(_)) => "tcp".to_owned(),
        (None, None) => description.robot.link(description.tip).name.clone(),
    }
}

/// Refuses rows in which a camera in the hand would have to see what it has not measured.
///
/// A row fixes a point in the frame of the tip; with one coordinate missing it fixes none.
pub(crate) fn may_be_seen(rows: &[MeasuredRow], camera: Option<CameraMount>) -> Result<(), Diagnostic> {
    if camera != Some(CameraMount::EyeInHand) {
        return Ok(());
    }
    let Some(row) = rows.iter().find(|row| target_m(row).is_none()) else { return Ok(()) };
    let message = format!(
        "line {} does not give x, y and z of the target in the frame of the camera, which is on the robot",
        row.line
    );
    Err(Diagnostic::error(codes::measurements::SEEN_POINT, message)
        .with_help("give all three coordinates, with or without an orientation, or leave the row out"))
}

/// The pose of the target in the camera in the hand; the rotation is the identity if none was measured.
pub(crate) fn camera_from_target(row: &MeasuredRow) -> Option<Pose> {
    let rotation = row.orientation.map_or_else(Matrix3::identity, |each| each.base_from_tip());
    target_m(row).map(|translation| Pose::from_parts(rotation, translation))
}

fn target_m(row: &MeasuredRow) -> Option<Vector3<f64>> {
    let [x, y, z] = row.tip_in_base_m;
    Some(Vector3::new(x?, y?, z?))
}
