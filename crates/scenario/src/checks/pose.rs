//! Settings of the checks of link poses and of the tool.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    on_violation::OnViolation,
    unit_keys::{UnitKeys, in_two_units},
};
use crate::{
    PoseSettings,
    number::{optional_inner_share, optional_non_negative, optional_positive},
    text::variant,
};

/// Model against twin: poses of all links at every sample. The default limits are the robot file's tolerance.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AgreementCheck {
    /// Largest distance of the origins of a link, in metres or in millimetres.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub position_m: Option<f64>,
    /// The same in millimetres.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub position_mm: Option<f64>,
    /// Largest angle between the orientations of a link, in radians or in degrees.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub orientation_rad: Option<f64>,
    /// The same in degrees.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub orientation_deg: Option<f64>,
    /// Share of all possible cases of `[uncertainty]` in which the check must pass, below 1; default: in every case of the run.
    #[serde(default, deserialize_with = "optional_inner_share", skip_serializing_if = "Option::is_none")]
    pub passing: Option<f64>,
    /// What the run does at the first violation of the check.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

/// The TCP is at a target at the end of the run. A pose needs both tolerances, a position only the first.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GoalCheck {
    /// Pose or position of the twin's TCP at the end, in the world.
    pub tcp: PoseSettings,
    /// Largest distance from the target, in metres or in millimetres.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub position_m: Option<f64>,
    /// The same in millimetres.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub position_mm: Option<f64>,
    /// Largest angle from the target, in radians or in degrees; only if the target has a rotation.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub orientation_rad: Option<f64>,
    /// The same in degrees.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub orientation_deg: Option<f64>,
    /// Share of all possible cases of `[uncertainty]` in which the check must pass, below 1; default: in every case of the run.
    #[serde(default, deserialize_with = "optional_inner_share", skip_serializing_if = "Option::is_none")]
    pub passing: Option<f64>,
    /// What the run does at the first violation of the check.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

/// The velocity of the TCP by the Jacobian at the measured joint positions and velocities, against the change of the twin's
/// TCP pose. The default limits are proportional to the square of the length of a step.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TwistCheck {
    /// Largest difference of the TCP's velocity, in m/s or in mm/s.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub linear_m_s: Option<f64>,
    /// The same in mm/s.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub linear_mm_s: Option<f64>,
    /// Largest difference of the TCP's angular velocity, in rad/s or in deg/s.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub angular_rad_s: Option<f64>,
    /// The same in deg/s.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub angular_deg_s: Option<f64>,
    /// Share of all possible cases of `[uncertainty]` in which the check must pass, below 1; default: in every case of the run.
    #[serde(default, deserialize_with = "optional_inner_share", skip_serializing_if = "Option::is_none")]
    pub passing: Option<f64>,
    /// What the run does at the first violation of the check.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

/// Rotations are orthonormal, joint constraints hold, and joint states are finite numbers.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InvariantsCheck {
    /// Largest error of a link's rotation, of model and twin: of `R' R - 1` in the Frobenius norm, and of the determinant.
    /// Default: a small multiple of rounding.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub rotation: Option<f64>,
    /// Share of all possible cases of `[uncertainty]` in which the check must pass, below 1; default: in every case of the run.
    #[serde(default, deserialize_with = "optional_inner_share", skip_serializing_if = "Option::is_none")]
    pub passing: Option<f64>,
    /// What the run does at the first violation of the check.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

impl AgreementCheck {
    /// Position and orientation in SI units.
    pub fn limits(&self) -> [Option<f64>; 2] {
        self.unit_keys().map(|keys| keys.value())
    }

    /// The values that a file may give in one of two units: position, orientation.
    pub(crate) fn unit_keys(&self) -> [UnitKeys; 2] {
        [in_two_units!(self, position_m, position_mm), in_two_units!(self, orientation_rad, orientation_deg)]
    }
}

impl GoalCheck {
    /// The values that a file may give in one of two units: position, orientation.
    pub fn unit_keys(&self) -> [UnitKeys; 2] {
        [in_two_units!(self, position_m, position_mm), in_two_units!(self, orientation_rad, orientation_deg)]
    }
}

impl TwistCheck {
    /// The values that a file may give in one of two units: linear, angular.
    pub fn unit_keys(&self) -> [UnitKeys; 2] {
        [in_two_units!(self, linear_m_s, linear_mm_s), in_two_units!(self, angular_rad_s, angular_deg_s)]
    }
}
