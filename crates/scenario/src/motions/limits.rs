//! `[limits]`: limits of planned motions, in addition to the velocity limits of the robot's description.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::text::variant;

/// Values by joint; `*` means every joint of this kind (turning or sliding) that is not named.
type ByJoint = BTreeMap<String, f64>;

/// `[limits]`: limits of planned motions. Velocities are those of the description, accelerations those under `[limits]` of the
/// robot file, or lower ones that are given here. By default, a joint reaches its velocity limit in 0.25 s and its
/// acceleration limit in 0.1 s; only motions of least time, without `duration_s`, keep these default limits.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LimitSettings {
    /// What happens to a motion that violates a limit: `refuse`, `slow` or `warn`.
    #[serde(default, deserialize_with = "variant")]
    pub over_limit: OverLimit,
    /// Velocities by joint, in degrees per second.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub velocity_deg_s: ByJoint,
    /// Velocities by joint, in radians per second.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub velocity_rad_s: ByJoint,
    /// Velocities by joint, in metres per second.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub velocity_m_s: ByJoint,
    /// Velocities by joint, in millimetres per second.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub velocity_mm_s: ByJoint,
    /// Accelerations by joint, in degrees per second squared.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub acceleration_deg_s2: ByJoint,
    /// Accelerations by joint, in radians per second squared.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub acceleration_rad_s2: ByJoint,
    /// Accelerations by joint, in metres per second squared.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub acceleration_m_s2: ByJoint,
    /// Accelerations by joint, in millimetres per second squared.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub acceleration_mm_s2: ByJoint,
    /// Jerks by joint, in degrees per second cubed.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub jerk_deg_s3: ByJoint,
    /// Jerks by joint, in radians per second cubed.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub jerk_rad_s3: ByJoint,
    /// Jerks by joint, in metres per second cubed.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub jerk_m_s3: ByJoint,
    /// Jerks by joint, in millimetres per second cubed.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub jerk_mm_s3: ByJoint,
}

/// What happens to a planned motion that violates a limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OverLimit {
    /// The scenario is refused; the message gives the shortest feasible duration.
    #[default]
    Refuse,
    /// The motion takes the shortest feasible duration, with a warning.
    Slow,
    /// The motion is not changed, with a warning: to test how a controller copes with it.
    Warn,
}
