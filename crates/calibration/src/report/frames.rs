//! Base and tool as the recommended estimate has them.

use congruent_description::RobotDescription;
use congruent_kinematics::{Pose, ReportedPose};
use schemars::JsonSchema;
use serde::Serialize;

use crate::{camera::CameraFrames, chain::NominalChain, computed::Computed, estimation::Displacements};

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
    let tip_from_measured = tip_from_measured(computed.description, &computed.nominal, &moved);
    if let Some(mount) = computed.options.camera {
        let poses = [&moved.base, &tip_from_measured];
        return (None, Some(CameraFrames::new(computed.description, mount, computed.rows, poses)));
    }
    let found = EstimatedFrames {
        measured_from_base: Some(&moved.base).filter(is_moved).map(ReportedPose::from),
        tip_from_measured: Some(&moved.tool).filter(is_moved).map(|_| ReportedPose::from(&tip_from_measured)),
    };
    let is_displaced = found.measured_from_base.is_some() || found.tip_from_measured.is_some();
    (is_displaced.then_some(found), None)
}

/// Pose of the measured frame in link `tip`, with the corrections of the tool.
pub(crate) fn tip_from_measured(
    description: &RobotDescription,
    nominal: &NominalChain<'_>,
    moved: &Displacements,
) -> Pose {
    let base_from_tcp = nominal.chain.base_from_tip_at_zero;
    let tip_from_tcp = description.tip_from_tcp.map_or(Pose::identity(), Pose::from);
    let base_from_tip = base_from_tcp * tip_from_tcp.inverse();
    base_from_tip.inverse() * moved.tool * base_from_tcp
}
