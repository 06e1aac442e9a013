//! `[start]`: joint positions by name, in the unit that the key names.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Positions at the start; joints that are not named start at 0, or at the limit nearest to 0.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StartSettings {
    /// Angles in degrees by joint.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub joints_deg: BTreeMap<String, f64>,
    /// Angles in radians by joint.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub joints_rad: BTreeMap<String, f64>,
    /// Shifts in metres by joint.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub joints_m: BTreeMap<String, f64>,
    /// Shifts in millimetres by joint.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub joints_mm: BTreeMap<String, f64>,
}
