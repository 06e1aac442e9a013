//! A camera that sees a target: where it is mounted, and which rows of measurements it can have.

use std::fmt;

use congruent_description::RobotDescription;
use congruent_input::Diagnostic;
use congruent_kinematics::{Pose, ReportedPose};
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

/// The groups of corrections that are the poses of camera and target.
pub const CAMERA_GROUPS: [&str; 2] = ["base", "tool"];

/// Camera and target with the recommended estimate. The other corrections are right together with these.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct CameraFrames {
    /// Where the camera is mounted.
    pub mount: CameraMount,
    /// The camera: on link `tip` in the hand, otherwise on link `base`.
    pub camera: FrameOnLink,
    /// The target: on link `base` if the camera is in the hand, otherwise on link `tip`.
    pub target: FrameOnLink,
    /// Whether orientations of the target were measured; otherwise its orientation here is arbitrary.
    pub has_orientation: bool,
}

/// A frame that is fixed to a link.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FrameOnLink {
    /// Name of the link.
    pub link: String,
    /// Pose of the frame in the link.
    pub link_from_frame: ReportedPose,
}

impl fmt::Display for CameraMount {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(formatter)
    }
}

impl CameraFrames {
    /// Camera and target from the poses of a calibration: of the base in the frame of the measurements, and of the measured frame in
    /// the tip.
    pub(crate) fn new(
        description: &RobotDescription,
        mount: CameraMount,
        rows: &[MeasuredRow],
        [measured_from_base, tip_from_measured]: [&Pose; 2],
    ) -> Self {
        let has_orientation = rows.iter().any(|row| row.orientation.is_some());
        let on = |link, pose: &Pose| FrameOnLink {
            link: description.robot.link(link).name.clone(),
            link_from_frame: ReportedPose::from(pose),
        };
        let on_base = on(description.base, &measured_from_base.inverse());
        let on_tip = on(description.tip, tip_from_measured);
        match mount {
            CameraMount::EyeInHand => Self { mount, camera: on_tip, target: on_base, has_orientation },
            CameraMount::EyeToHand => Self { mount, camera: on_base, target: on_tip, has_orientation },
        }
    }
}

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
