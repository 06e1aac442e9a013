//! Settings of the checks of what was recorded of a robot.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    on_violation::OnViolation,
    unit_keys::{UnitKeys, in_two_units},
};
use crate::{
    number::{optional_positive, optional_share},
    text::variant,
};

/// Recorded poses against those of the model at the joint positions of the same instant.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PoseCheck {
    /// Largest distance of the positions, in metres or in millimetres; default: 2 mm.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub position_m: Option<f64>,
    /// The same in millimetres.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub position_mm: Option<f64>,
    /// Largest angle between the orientations, in radians or in degrees; default: 0.01 rad.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub orientation_rad: Option<f64>,
    /// The same in degrees.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub orientation_deg: Option<f64>,
    /// What the run does at the first violation of the check.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

/// How much of the log could be used.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RecordingCheck {
    /// Smallest share of the log in which every joint is known; default: 0.9.
    #[serde(default, deserialize_with = "optional_share", skip_serializing_if = "Option::is_none")]
    pub used_share: Option<f64>,
    /// Longest time between two samples; default: none.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub longest_gap_s: Option<f64>,
    /// What the run does at the first violation of the check.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

/// A jump of one joint's zero while the run goes on, as the error of the poses shows it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StepCheck {
    /// Largest jump of a joint that turns, in radians or in degrees; default: 0.1 deg.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub angle_rad: Option<f64>,
    /// The same in degrees.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub angle_deg: Option<f64>,
    /// Largest jump of a joint that slides, in metres or in millimetres; default: 1 mm.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub shift_m: Option<f64>,
    /// The same in millimetres.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub shift_mm: Option<f64>,
    /// What the run does at the first violation of the check.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

/// A point of the tool that is at one place whenever the arm is at rest, such as a ball in a hole.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SamePointCheck {
    /// Largest distance of the TCP from the mean of its places, in metres or in millimetres; default: 2 mm.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub spread_m: Option<f64>,
    /// The same in millimetres.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub spread_mm: Option<f64>,
    /// Shortest time for which the arm is at rest at a place; default: 0.5 s.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub still_s: Option<f64>,
    /// What the run does at the first violation of the check.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

/// Reported velocities against the change of the reported positions: their unit, their sign, and how late they are.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VelocityCheck {
    /// Largest difference of the factor between both from 1; default: 0.2.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub factor: Option<f64>,
    /// What the run does at the first violation of the check.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

impl PoseCheck {
    pub(crate) fn unit_keys(&self) -> [UnitKeys; 2] {
        [in_two_units!(self, position_m, position_mm), in_two_units!(self, orientation_rad, orientation_deg)]
    }

    /// The limits in m and rad, where they are given.
    pub fn limits(&self) -> [Option<f64>; 2] {
        self.unit_keys().map(|keys| keys.value())
    }
}

impl SamePointCheck {
    pub(crate) fn unit_keys(&self) -> [UnitKeys; 1] {
        [in_two_units!(self, spread_m, spread_mm)]
    }

    /// The limit in m, if it is given.
    pub fn limit_m(&self) -> Option<f64> {
        self.unit_keys()[0].value()
    }
}

impl StepCheck {
    pub(crate) fn unit_keys(&self) -> [UnitKeys; 2] {
        [in_two_units!(self, angle_rad, angle_deg), in_two_units!(self, shift_m, shift_mm)]
    }

    /// The limits in rad and m, where they are given.
    pub fn limits(&self) -> [Option<f64>; 2] {
        self.unit_keys().map(|keys| keys.value())
    }
}
