//! Settings of the checks of distances.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    on_violation::OnViolation,
    unit_keys::{UnitKeys, in_two_units},
};
use crate::{
    number::{optional_inner_share, optional_non_negative},
    text::variant,
};

/// Links keep a minimum distance from each other and from obstacles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ClearanceCheck {
    /// Smallest distance, in metres or in millimetres.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub minimum_m: Option<f64>,
    /// The same in millimetres.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub minimum_mm: Option<f64>,
    /// Only these pairs of links and obstacles are checked, in either order; in a name, `*` matches any
    /// characters. Default: all pairs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pairs: Vec<[String; 2]>,
    /// Pairs that are not checked, in either order; in a name, `*` matches any characters.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ignore: Vec<[String; 2]>,
    /// Share of all possible cases of `[uncertainty]` in which the check must pass, below 1; default: in every case of the run.
    #[serde(default, deserialize_with = "optional_inner_share", skip_serializing_if = "Option::is_none")]
    pub passing: Option<f64>,
    /// What the run does at the first violation of the check.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

/// No link touches another link or an obstacle; with a depth, no pair overlaps by more; with a force, no link pushes an
/// obstacle by more.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContactCheck {
    /// Largest overlap of two shapes, in metres or in millimetres; default: they may not even touch.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub depth_m: Option<f64>,
    /// The same in millimetres.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub depth_mm: Option<f64>,
    /// Largest normal force between a link and an obstacle, N: without a depth, the two may then touch. Only the physics knows
    /// it, and only between links and obstacles.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub force_n: Option<f64>,
    /// Only these pairs of links and obstacles are checked, in either order; in a name, `*` matches any
    /// characters. Default: all pairs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pairs: Vec<[String; 2]>,
    /// Pairs that are not checked, in either order; in a name, `*` matches any characters.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ignore: Vec<[String; 2]>,
    /// Share of all possible cases of `[uncertainty]` in which the check must pass, below 1; default: in every case of the run.
    #[serde(default, deserialize_with = "optional_inner_share", skip_serializing_if = "Option::is_none")]
    pub passing: Option<f64>,
    /// What the run does at the first violation of the check.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

/// No link touches a zone that is forbidden to it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ZoneCheck {
    /// Share of all possible cases of `[uncertainty]` in which the check must pass, below 1; default: in every case of the run.
    #[serde(default, deserialize_with = "optional_inner_share", skip_serializing_if = "Option::is_none")]
    pub passing: Option<f64>,
    /// What the run does at the first violation of the check.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

impl ClearanceCheck {
    /// The smallest distance in metres.
    pub fn limit_m(&self) -> Option<f64> {
        self.unit_keys().value()
    }

    /// The minimum distance, which a file may give in one of two units.
    pub fn unit_keys(&self) -> UnitKeys {
        in_two_units!(self, minimum_m, minimum_mm)
    }
}

impl ContactCheck {
    /// The largest depth in metres; `None` if shapes may not even touch.
    pub fn limit_m(&self) -> Option<f64> {
        self.unit_keys().value()
    }

    /// The largest depth, which a file may give in one of two units.
    pub fn unit_keys(&self) -> UnitKeys {
        in_two_units!(self, depth_m, depth_mm)
    }
}
