//! A target as a file gives it.

use std::collections::BTreeMap;

use congruent_configurations::unique_names;
use serde::Deserialize;

/// One target as written.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenTarget {
    pub(super) translation_m: [f64; 3],
    pub(super) quaternion_wxyz: Option<[f64; 4]>,
    #[serde(default, deserialize_with = "unique_names")]
    pub(super) start: BTreeMap<String, f64>,
}
