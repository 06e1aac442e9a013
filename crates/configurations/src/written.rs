//! A configuration as a file gives it.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Deserialize;

use crate::unique::unique_names;

/// One entry of a batch, joints by name; joints of groups that a command does not use are checked too.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Configuration")]
pub(super) struct WrittenConfiguration {
    /// Positions in rad and m; joints that are not named are at 0.
    #[serde(default, deserialize_with = "unique_names")]
    pub(super) q: BTreeMap<String, f64>,
    /// Velocities in rad/s and m/s.
    #[serde(default, deserialize_with = "unique_names")]
    pub(super) v: BTreeMap<String, f64>,
    /// Torques in N m and forces in N.
    #[serde(default, deserialize_with = "unique_names")]
    pub(super) tau: BTreeMap<String, f64>,
    /// Accelerations in rad/s² and m/s².
    #[serde(default, deserialize_with = "unique_names")]
    pub(super) a: BTreeMap<String, f64>,
}
