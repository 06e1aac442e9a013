//! Values and poses in the forms that reports need.

use congruent_kinematics::Pose;
use nalgebra::{Isometry3, Rotation3, Translation3, UnitQuaternion};
use schemars::JsonSchema;
use serde::Serialize;

/// A found or expected value.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum ReportedValue {
    /// A number in rad, m, or without unit.
    Number(f64),
    /// Several numbers with their keys, or a word.
    Text(String),
}

/// A pose in the form that files write.
pub(super) fn isometry(pose: &Pose) -> Isometry3<f64> {
    let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(pose.rotation));
    Isometry3::from_parts(Translation3::from(pose.translation), rotation)
}
