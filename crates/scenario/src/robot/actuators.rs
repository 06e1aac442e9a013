//! `[joints]`: resistances of the joints and limits of their actuators, in place of those of the description.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::joint_numbers::JointNumbers;

/// `[joints]`: damping, dry friction and armature instead of the description's, and whether actuators have limits. Both
/// the physics and the model have them. In a table by joint, joints that are not named keep what the description says.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointSettings {
    /// Viscous damping: N m s/rad, N s/m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damping: Option<JointNumbers>,
    /// Dry friction: N m, N.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<JointNumbers>,
    /// Inertia of motor and gear, reflected to the joint: kg m^2, kg. A URDF has no such value, an MJCF has.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub armature: Option<JointNumbers>,
    /// Whether actuators keep the limits of effort and velocity that the description gives.
    #[serde(default = "yes")]
    pub enforce_limits: bool,
}

fn yes() -> bool {
    true
}

impl Default for JointSettings {
    fn default() -> Self {
        Self { damping: None, friction: None, armature: None, enforce_limits: true }
    }
}
