//! Checks of distances.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    on_violation::OnViolation,
    unit_keys::{UnitKeys, length},
};
use crate::scenario::{number::optional_non_negative, text::variant};

/// Links come no closer to each other and to obstacles than this.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ClearanceCheck {
    /// Smallest distance, in metres or in millimetres.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub minimum_m: Option<f64>,
    /// The same in millimetres.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub minimum_mm: Option<f64>,
    /// Only these pairs of links and obstacles are checked, in either order; in a name, `*` stands for any
    /// characters. All pairs if it is left out.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pairs: Vec<[String; 2]>,
    /// Pairs that are not checked, likewise.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ignore: Vec<[String; 2]>,
    /// What follows its first violation.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

/// No link touches another or an obstacle; with a depth, none overlaps by more.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContactCheck {
    /// How deep two shapes may overlap, in metres or in millimetres; if it is left out, they may not even touch.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub depth_m: Option<f64>,
    /// The same in millimetres.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub depth_mm: Option<f64>,
    /// Only these pairs of links and obstacles are checked, in either order; in a name, `*` stands for any
    /// characters. All pairs if it is left out.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pairs: Vec<[String; 2]>,
    /// Pairs that are not checked, likewise.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ignore: Vec<[String; 2]>,
    /// What follows its first violation.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

/// No link touches a zone that is forbidden to it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ZoneCheck {
    /// What follows its first violation.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

impl ClearanceCheck {
    /// The smallest distance in metres.
    pub fn limit_m(&self) -> Option<f64> {
        self.unit_keys().value()
    }

    /// The distance.
    pub(crate) fn unit_keys(&self) -> UnitKeys {
        length(["minimum_m", "minimum_mm"], [self.minimum_m, self.minimum_mm])
    }
}

impl ContactCheck {
    /// The largest depth in metres; `None` if shapes may not even touch.
    pub fn limit_m(&self) -> Option<f64> {
        self.unit_keys().value()
    }

    /// The depth.
    pub(crate) fn unit_keys(&self) -> UnitKeys {
        length(["depth_m", "depth_mm"], [self.depth_m, self.depth_mm])
    }
}
