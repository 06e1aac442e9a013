//! A plan file as it is written.

use schemars::{JsonSchema, Schema, schema_for};
use serde::Deserialize;
use toml::Spanned;

use congruent_input::fixed_array;

use crate::sampling::CaseSampling;

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
    #[schemars(with = "Vec<WrittenVary>")]
    pub(super) vary: Vec<Spanned<WrittenVary>>,
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

fn usual_confidence() -> f64 {
    0.95
}

/// One `[[vary]]`: keys and one distribution.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenVary {
    /// A key of the scenario, as of --set; one that begins with robot. is of the robot. Several keys get the same value.
    #[schemars(with = "OneOrMore")]
    pub(super) key: Spanned<toml::Value>,
    /// Evenly between two numbers.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "Option<[f64; 2]>")]
    pub(super) uniform: Option<Spanned<[f64; 2]>>,
    /// Evenly between the logarithms of two positive numbers.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "Option<[f64; 2]>")]
    pub(super) log_uniform: Option<Spanned<[f64; 2]>>,
    /// Normally distributed, by mean and standard deviation.
    pub(super) normal: Option<WrittenNormal>,
    /// From the first to the last number, the one between them most often.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "Option<[f64; 3]>")]
    pub(super) triangular: Option<Spanned<[f64; 3]>>,
    /// One of these values, each as often.
    #[schemars(with = "Option<Vec<serde_json::Value>>")]
    pub(super) values: Option<Vec<toml::Value>>,
    /// Number of values of a range on a grid, both ends among them.
    pub(super) steps: Option<u32>,
}

/// A normal distribution.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenNormal {
    /// Its mean.
    pub(super) mean: f64,
    /// Its standard deviation.
    pub(super) deviation: f64,
    /// The least value: the distribution is cut there.
    pub(super) min: Option<f64>,
    /// The largest value: the distribution is cut there.
    pub(super) max: Option<f64>,
}

/// A text, or a list of texts, as the schema says it.
#[derive(JsonSchema)]
#[serde(untagged)]
#[expect(dead_code, reason = "only its schema is used")]
enum OneOrMore {
    /// One.
    One(String),
    /// Several.
    More(Vec<String>),
}

impl WrittenVary {
    /// The keys; `None` if they are neither a text nor a list of texts.
    pub(super) fn keys(&self) -> Option<Vec<String>> {
        match self.key.get_ref() {
            toml::Value::String(key) => Some(vec![key.clone()]),
            toml::Value::Array(keys) if !keys.is_empty() => {
                keys.iter().map(|key| key.as_str().map(str::to_owned)).collect()
            }
            _ => None,
        }
    }
}

/// The schema of plan files.
pub fn sweep_plan_schema() -> Schema {
    schema_for!(WrittenPlan)
}
