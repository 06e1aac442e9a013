//! Poses in the JSON of reports.

use nalgebra::{Quaternion, UnitQuaternion};
use schemars::JsonSchema;
use serde::Serialize;

use super::{euler::EulerSet, pose::Pose};

/// A pose as programs read it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct ReportedPose {
    /// Origin, in the root link's frame if nothing else is said.
    pub translation_m: [f64; 3],
    /// Orientation in the same frame; the first component that is not zero is positive.
    pub quaternion_wxyz: [f64; 4],
}

impl ReportedPose {
    /// Roll, pitch and yaw about the fixed axes x, y, z; the yaw is 0 if the pitch is a quarter turn.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::{Pose, ReportedPose};
    /// let half = 0.5_f64.sqrt();
    /// let pose = ReportedPose { translation_m: [0.0; 3], quaternion_wxyz: [half, 0.0, 0.0, half] };
    /// assert!((pose.rpy_rad()[2] - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    /// ```
    pub fn rpy_rad(&self) -> [f64; 3] {
        let [w, x, y, z] = self.quaternion_wxyz;
        let rotation = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)).to_rotation_matrix();
        let [yaw, pitch, roll] = EulerSet::Zyx.angles(rotation.matrix()).angles_rad;
        [roll, pitch, yaw]
    }
}

impl From<&ReportedPose> for Pose {
    fn from(pose: &ReportedPose) -> Self {
        let [w, x, y, z] = pose.quaternion_wxyz;
        let rotation = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)).to_rotation_matrix();
        Self::from_parts(rotation.into_inner(), pose.translation_m.into())
    }
}

impl From<&Pose> for ReportedPose {
    fn from(pose: &Pose) -> Self {
        Self { translation_m: pose.translation.into(), quaternion_wxyz: pose.quaternion_wxyz() }
    }
}
