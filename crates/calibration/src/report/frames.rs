//! Base and tool as the recommended estimate has them.

use congruent_kinematics::{Pose, ReportedPose};
use schemars::JsonSchema;
use serde::Serialize;

use crate::{
    camera_frames::{CameraEstimate, CameraFrames},
    computed::Computed,
    estimation::Displacements,
};

/// Base and tool with the recommended estimate. The other corrections are right together with these.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct EstimatedFrames {
    /// Pose of link `base` in the frame in which the rows were measured; left out if it is that frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measured_from_base: Option<ReportedPose>,
    /// Pose of the measured frame in link `tip`; left out if the tool was not displaced.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tip_from_measured: Option<ReportedPose>,
}

/// The poses of base and tool that are estimated: those of camera and target if a camera measured the rows, otherwise of what is
/// displaced.
pub(super) fn frames(computed: &Computed<'_>) -> (Option<EstimatedFrames>, Option<CameraFrames>) {
    let moved = Displacements::new(&computed.chain, &computed.best().corrections);
    let is_moved = |pose: &&Pose| **pose != Pose::identity();
    let tip_from_measured = computed.nominal.tip_from_measured(&moved.tool);
    if let Some(mount) = computed.options.camera {
        let is_noise_known = computed.redundancy > 0 || computed.options.noise.is_some();
        let covariance = (&computed.identification.kept[..], &computed.best().covariance);
        let estimate = CameraEstimate {
            mount,
            description: computed.description,
            nominal: &computed.nominal,
            chain: &computed.chain,
            corrections: &computed.best().corrections,
            covariance: is_noise_known.then_some(covariance),
            fixed: &computed.identification.fixed,
            has_orientation: computed.rows.iter().any(|row| row.orientation.is_some()),
        };
        return (None, Some(estimate.frames()));
    }
    let found = EstimatedFrames {
        measured_from_base: Some(&moved.base).filter(is_moved).map(ReportedPose::from),
        tip_from_measured: Some(&moved.tool).filter(is_moved).map(|_| ReportedPose::from(&tip_from_measured)),
    };
    let is_displaced = found.measured_from_base.is_some() || found.tip_from_measured.is_some();
    (is_displaced.then_some(found), None)
}
