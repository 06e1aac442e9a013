//! Values and poses in the forms that reports need.

use congruent_input::{
    Slack,
    units::{Unit, UnitSystem},
};
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

/// The expected value as a file writes it: short, but with enough digits to differ from the found one.
pub(super) fn value_literal(
    unit: Unit,
    units: UnitSystem,
    found: f64,
    expected: f64,
    slack: Slack,
) -> String {
    /// Part of its change that a value may be off.
    const PART_OF_CHANGE: f64 = 0.05;
    // A correction of 1e-8 must not be rounded away: the written value has to differ clearly from the one in the
    // file.
    let most = PART_OF_CHANGE * (found - expected).abs();
    let slack = Slack { length_m: slack.length_m.min(most), angle_rad: slack.angle_rad.min(most) };
    unit.fitted(expected, units, slack)
}
