//! Settings of the checks of the joints' motion.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    on_violation::OnViolation,
    unit_keys::{UnitKeys, in_two_units},
};
use crate::{
    number::{optional_inner_share, optional_non_negative, optional_positive, positive},
    text::variant,
};

/// Position, velocity and effort of each joint within the limits that the description states.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LimitsCheck {
    /// Largest excess of a turning joint over its position limit, in rad or in degrees; default 1e-6 rad.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub tolerance_rad: Option<f64>,
    /// The same in degrees.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub tolerance_deg: Option<f64>,
    /// Largest excess of a sliding joint over its position limit, in metres or in millimetres; default 1e-6 m.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub tolerance_m: Option<f64>,
    /// The same in millimetres.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub tolerance_mm: Option<f64>,
    /// Smallest margin of a turning joint to its position limit, in rad or in degrees.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub margin_rad: Option<f64>,
    /// The same in degrees.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub margin_deg: Option<f64>,
    /// Smallest margin of a sliding joint to its position limit, in metres or in millimetres.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub margin_m: Option<f64>,
    /// The same in millimetres.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub margin_mm: Option<f64>,
    /// Largest share of a joint's velocity limit; default 1.001, which the actuators allow.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub velocity_share: Option<f64>,
    /// Largest share of a joint's effort limit; default 1.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub effort_share: Option<f64>,
    /// Share of all possible cases of `[uncertainty]` in which the check must pass, below 1; default: in every case of the run.
    #[serde(default, deserialize_with = "optional_inner_share", skip_serializing_if = "Option::is_none")]
    pub passing: Option<f64>,
    /// What the run does at the first violation of the check.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

/// The twin follows its setpoint. At least one limit is given; quantities without a limit are not checked.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TrackingCheck {
    /// Largest error of a joint that turns, at any instant, in rad or in degrees.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub path_rad: Option<f64>,
    /// The same in degrees.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub path_deg: Option<f64>,
    /// Largest error of a joint that slides, at any instant, in metres or in millimetres.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub path_m: Option<f64>,
    /// The same in millimetres.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub path_mm: Option<f64>,
    /// Largest distance of the TCP from its position at the setpoint, at any instant, in metres or in millimetres.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub path_tcp_m: Option<f64>,
    /// The same in millimetres.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub path_tcp_mm: Option<f64>,
    /// Largest error of a joint that turns, at the end of the run, in rad or in degrees.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub goal_rad: Option<f64>,
    /// The same in degrees.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub goal_deg: Option<f64>,
    /// Largest error of a joint that slides, at the end of the run, in metres or in millimetres.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub goal_m: Option<f64>,
    /// The same in millimetres.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub goal_mm: Option<f64>,
    /// Largest error of the TCP, at the end of the run, in metres or in millimetres.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub goal_tcp_m: Option<f64>,
    /// The same in millimetres.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub goal_tcp_mm: Option<f64>,
    /// Longest time from the end of a motion until all joints stay within their goal limits.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub settling_s: Option<f64>,
    /// Smallest share of its commanded travel that each joint makes in the run: least to largest position, of the joint and of its
    /// setpoint; negative if it goes the other way. Joints that are commanded to move by less than 1e-3 rad or m are not judged.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub travel_share: Option<f64>,
    /// Largest overshoot of a turning joint beyond a setpoint that has stopped, in rad or in degrees.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub overshoot_rad: Option<f64>,
    /// The same in degrees.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub overshoot_deg: Option<f64>,
    /// Largest overshoot of a sliding joint beyond a setpoint that has stopped, in metres or in millimetres.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub overshoot_m: Option<f64>,
    /// The same in millimetres.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub overshoot_mm: Option<f64>,
    /// Share of all possible cases of `[uncertainty]` in which the check must pass, below 1; default: in every case of the run.
    #[serde(default, deserialize_with = "optional_inner_share", skip_serializing_if = "Option::is_none")]
    pub passing: Option<f64>,
    /// What the run does at the first violation of the check.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

/// All motions are finished in time: the arm is at rest at the end of the last motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CycleTimeCheck {
    /// Longest time from the start of the run.
    #[serde(deserialize_with = "positive")]
    pub limit_s: f64,
    /// Largest distance of a turning joint from the end of the last motion, in rad or in degrees; default 1e-3 rad.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub tolerance_rad: Option<f64>,
    /// The same in degrees.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub tolerance_deg: Option<f64>,
    /// Largest distance of a sliding joint from the end of the last motion, in metres or in millimetres; default 1e-3 m.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub tolerance_m: Option<f64>,
    /// The same in millimetres.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub tolerance_mm: Option<f64>,
    /// Share of all possible cases of `[uncertainty]` in which the check must pass, below 1; default: in every case of the run.
    #[serde(default, deserialize_with = "optional_inner_share", skip_serializing_if = "Option::is_none")]
    pub passing: Option<f64>,
    /// What the run does at the first violation of the check.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

impl LimitsCheck {
    /// The values that a file may give in one of two units: tolerance and margin of joints that turn, then of those that
    /// slide.
    pub fn unit_keys(&self) -> [UnitKeys; 4] {
        [
            in_two_units!(self, tolerance_rad, tolerance_deg),
            in_two_units!(self, margin_rad, margin_deg),
            in_two_units!(self, tolerance_m, tolerance_mm),
            in_two_units!(self, margin_m, margin_mm),
        ]
    }
}

impl TrackingCheck {
    /// The values that a file may give in one of two units: path, goal and overshoot, each of joints that turn, of joints that
    /// slide and of the TCP, which has no overshoot.
    pub fn unit_keys(&self) -> [UnitKeys; 8] {
        [
            in_two_units!(self, path_rad, path_deg),
            in_two_units!(self, path_m, path_mm),
            in_two_units!(self, path_tcp_m, path_tcp_mm),
            in_two_units!(self, goal_rad, goal_deg),
            in_two_units!(self, goal_m, goal_mm),
            in_two_units!(self, goal_tcp_m, goal_tcp_mm),
            in_two_units!(self, overshoot_rad, overshoot_deg),
            in_two_units!(self, overshoot_m, overshoot_mm),
        ]
    }
}

impl CycleTimeCheck {
    /// The tolerances: of joints that turn, and of joints that slide.
    pub fn unit_keys(&self) -> [UnitKeys; 2] {
        [in_two_units!(self, tolerance_rad, tolerance_deg), in_two_units!(self, tolerance_m, tolerance_mm)]
    }
}
