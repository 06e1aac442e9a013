//! `[sensors]`: resolution and noise of the encoders.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::joint_numbers::JointNumbers;

/// `[sensors]`: encoders between the true state and the state that controllers and checks get. Exact without this section.
///
/// Each value is a number for all joints to which its unit applies, turning or sliding, or a table by joint; joints that
/// a table does not name are exact. The noise follows from the scenario's seed.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SensorSettings {
    /// Counts of the encoder in a turn of the joint, instead of a resolution.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub counts_per_turn: Option<JointNumbers>,
    /// Resolution of the encoders of turning joints; readings are rounded to its multiples.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub resolution_deg: Option<JointNumbers>,
    /// The same in radians.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub resolution_rad: Option<JointNumbers>,
    /// The same of sliding joints, in metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub resolution_m: Option<JointNumbers>,
    /// The same in millimetres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub resolution_mm: Option<JointNumbers>,
    /// Standard deviation of the noise of positions, before they are rounded: normally distributed, another value in
    /// every step. Of turning joints.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub noise_deg: Option<JointNumbers>,
    /// The same in radians.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub noise_rad: Option<JointNumbers>,
    /// The same of sliding joints, in metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub noise_m: Option<JointNumbers>,
    /// The same in millimetres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub noise_mm: Option<JointNumbers>,
    /// Origin of the measured velocities.
    #[serde(default)]
    pub velocity: VelocitySensor,
    /// Standard deviation of the noise of velocities that are measured directly: rad/s of turning joints.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity_noise_rad_s: Option<JointNumbers>,
    /// The same of sliding joints, m/s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity_noise_m_s: Option<JointNumbers>,
}

/// Origin of measured velocities.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum VelocitySensor {
    /// From a sensor of their own.
    #[default]
    Direct,
    /// From the difference of two readings of the encoder, one step apart.
    Differentiated,
}
