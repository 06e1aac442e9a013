//! A plan file as it is written.

use schemars::{JsonSchema, Schema, schema_for};
use serde::Deserialize;
use toml::Spanned;

use congruent_scenario::{CaseSampling, VarySettings, usual_confidence};

/// A plan file, `*.sweep.toml`.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WrittenPlan {
    /// Version of this format: 1.
    #[schemars(with = "u32")]
    pub(super) schema_version: Spanned<u32>,
    /// Name of the sweep.
    #[schemars(with = "String")]
    pub(super) name: Spanned<String>,
    /// The scenario, relative to this file.
    #[schemars(with = "String")]
    pub(super) scenario: Spanned<String>,
    /// How the values of the cases are chosen.
    #[serde(default)]
    pub(super) sampling: CaseSampling,
    /// Number of cases; a grid has as many as its values give.
    #[schemars(with = "Option<u64>")]
    pub(super) cases: Option<Spanned<u64>>,
    /// Seed of the sweep: the seed of each case follows from it and the number of the case.
    #[serde(default)]
    pub(super) seed: u64,
    /// Values that all cases have, as of --set.
    #[serde(default)]
    #[schemars(with = "std::collections::BTreeMap<String, serde_json::Value>")]
    pub(super) set: toml::Table,
    /// What `sweep merge` judges.
    #[schemars(with = "Option<WrittenRequirement>")]
    pub(super) require: Option<Spanned<WrittenRequirement>>,
    /// What varies.
    #[schemars(with = "Vec<VarySettings>")]
    pub(super) vary: Vec<Spanned<VarySettings>>,
}

/// `[require]`: the share of cases that must pass, and how well that must be known.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenRequirement {
    /// Share of all possible cases that must pass, below 1.
    pub(super) passing: f64,
    /// Confidence, below 1.
    #[serde(default = "usual_confidence")]
    pub(super) confidence: f64,
}

/// The schema of plan files.
pub fn sweep_plan_schema() -> Schema {
    schema_for!(WrittenPlan)
}
