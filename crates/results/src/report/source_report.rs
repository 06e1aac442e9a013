//! The log of a run in its report.

use congruent_scenario::{LoggedPoseSettings, PoseOrigin};
use congruent_twin::{RunSetup, setup::RecordedSetup};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::portable::portable;

/// The log whose joint states a run took.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SourceReport {
    /// The log, as it was named; its hash is among the `inputs`.
    pub log: String,
    /// Time that counts as 0, from the log time of the first message.
    pub origin_s: f64,
    /// The topics with joint states.
    pub joints: Vec<ReportedJointTopic>,
    /// Joints that the log does not have: they stay at their start.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub held: Vec<String>,
    /// The poses that were compared with the model.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub poses: Vec<ReportedPoses>,
}

/// A topic with joint states.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ReportedJointTopic {
    /// The topic.
    pub topic: String,
    /// Whether its states were commanded, not measured.
    pub is_setpoint: bool,
    /// Nothing is interpolated across a longer time without messages.
    pub maximum_gap_s: f64,
    /// The joints by their names in the log.
    pub joints: Vec<String>,
}

/// Poses of a log.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ReportedPoses {
    /// Their name: the topic, and of TF the frames.
    pub name: String,
    /// Where they come from.
    pub origin: PoseOrigin,
    /// Whether their frames were fitted to the log.
    pub frames_are_fitted: bool,
    /// Added to their times.
    pub offset_s: f64,
    /// Multiplied by their times and added, s/s.
    pub drift: f64,
}

impl SourceReport {
    /// The log of a setup, if it has one.
    pub(super) fn of(setup: &RunSetup) -> Option<Self> {
        let RecordedSetup { path, selection, poses, held, .. } = setup.recorded.as_ref()?;
        let settings = setup.scenario.source.as_ref()?;
        let joints = selection.joints.iter().map(|topic| ReportedJointTopic {
            topic: topic.topic.clone(),
            is_setpoint: topic.is_setpoint,
            maximum_gap_s: topic.maximum_gap_s,
            joints: topic.joints.iter().map(|joint| joint.name.clone()).collect(),
        });
        let of_poses = poses.iter().zip(&settings.pose).map(|(compared, settings)| {
            let &LoggedPoseSettings { origin, frames_are_fitted, offset_s, drift, .. } = settings;
            ReportedPoses { name: compared.name.clone(), origin, frames_are_fitted, offset_s, drift }
        });
        Some(Self {
            log: portable(path),
            origin_s: selection.origin_s,
            joints: joints.collect(),
            held: held.clone(),
            poses: of_poses.collect(),
        })
    }
}
