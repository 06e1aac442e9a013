//! Poses in the JSON of reports.

use schemars::JsonSchema;
use serde::Serialize;

use super::pose::Pose;

/// A pose as programs read it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct ReportedPose {
    /// Origin, in the root link's frame if nothing else is said.
    pub translation_m: [f64; 3],
    /// Orientation in the same frame; the first component that is not zero is positive.
    pub quaternion_wxyz: [f64; 4],
}

impl From<&Pose> for ReportedPose {
    fn from(pose: &Pose) -> Self {
        Self { translation_m: pose.translation.into(), quaternion_wxyz: pose.quaternion_wxyz() }
    }
}
