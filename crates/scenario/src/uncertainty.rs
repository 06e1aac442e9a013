//! What varies: distributions of values, as of a plan of a sweep and of `[uncertainty]`.

use std::fmt;

use schemars::JsonSchema;
use serde::{
    Deserialize, Deserializer, Serialize,
    de::{SeqAccess, Visitor, value::SeqAccessDeserializer},
};

use crate::number::{inner_share, optional_array};

/// `[uncertainty]`: values that are not known exactly. The scenario runs as it is written, and then once for each case with other
/// values. Controllers and planner know the masses, friction and robot that are written.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct UncertaintySettings {
    /// Number of cases.
    pub cases: u64,
    /// How the values of the cases are chosen.
    #[serde(default = "independent")]
    pub sampling: CaseSampling,
    /// Confidence, below 1, with which each check must pass in its share of all possible cases.
    #[serde(default = "usual_confidence", deserialize_with = "inner_share")]
    pub confidence: f64,
    /// Run this case alone, from 0, with page and recording.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub case: Option<u64>,
    /// What varies.
    pub vary: Vec<VarySettings>,
}

/// How the values of the cases are chosen.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CaseSampling {
    /// Every combination of the values; ranges have `steps`.
    Grid,
    /// Each case draws by itself.
    Random,
    /// Each of as many equal parts of a distribution as there are cases has one case.
    #[default]
    LatinHypercube,
    /// Scrambled Sobol points: each further case fills a gap. Up to 40 keys.
    Sobol,
}

impl CaseSampling {
    /// Why cases that are chosen so say nothing about the share of all possible ones; `None` if they do.
    pub fn no_sample(self) -> Option<&'static str> {
        (self == Self::Grid)
            .then_some("the cases of a grid are chosen, not drawn: they show no share of all possible cases")
    }
}

/// Number of cases that show, if none of them fails, that a share of all possible cases passes.
///
/// # Examples
/// ```
/// assert!((congruent_scenario::least_cases(0.99, 0.95) - 299.0).abs() < 0.5);
/// ```
pub fn least_cases(passing: f64, confidence: f64) -> f64 {
    // The share to the power of the number is at most the remaining probability.
    (libm::log(1.0 - confidence) / libm::log(passing)).ceil()
}

/// Independent draws: the bounds of the share of passing cases are then exact.
fn independent() -> CaseSampling {
    CaseSampling::Random
}

/// Confidence with which a share of cases must be known, if no other is given.
pub fn usual_confidence() -> f64 {
    0.95
}

/// Keys and one distribution.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VarySettings {
    /// A key of the scenario, as of --set; one that begins with robot. is of the robot. Several keys get the same value.
    pub key: VariedKeys,
    /// Evenly, up to so much below and above the value of the file. Of a list or table each number varies by itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plus_minus: Option<f64>,
    /// The same as a share of that value: percent = 20 is from 0.8 to 1.2 times the value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub percent: Option<f64>,
    /// Evenly between two numbers.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub uniform: Option<[f64; 2]>,
    /// Evenly between the logarithms of two positive numbers.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub log_uniform: Option<[f64; 2]>,
    /// Normally distributed, by mean and standard deviation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub normal: Option<NormalSettings>,
    /// From the first to the last number, the one between them most often.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub triangular: Option<[f64; 3]>,
    /// One of these values, each as often.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<Vec<serde_json::Value>>")]
    pub values: Option<Vec<toml::Value>>,
    /// Number of values of a range on a grid, both ends among them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub steps: Option<u32>,
}

/// A normal distribution.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NormalSettings {
    /// Its mean.
    pub mean: f64,
    /// Its standard deviation.
    pub deviation: f64,
    /// The least value: the distribution is cut there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min: Option<f64>,
    /// The largest value: the distribution is cut there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max: Option<f64>,
}

/// A key, or several that get the same value.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum VariedKeys {
    /// One key.
    One(String),
    /// Several keys.
    Several(Vec<String>),
}

impl Default for VariedKeys {
    fn default() -> Self {
        Self::Several(Vec::new())
    }
}

impl VariedKeys {
    /// The keys.
    pub fn as_slice(&self) -> &[String] {
        match self {
            Self::One(key) => std::slice::from_ref(key),
            Self::Several(keys) => keys,
        }
    }
}

impl<'de> Deserialize<'de> for VariedKeys {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(KeysVisitor)
    }
}

struct KeysVisitor;

impl<'de> Visitor<'de> for KeysVisitor {
    type Value = VariedKeys;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a key such as \"controller.stiffness\", or a list of keys")
    }

    fn visit_str<E>(self, key: &str) -> Result<VariedKeys, E> {
        Ok(VariedKeys::One(key.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, keys: A) -> Result<VariedKeys, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(keys)).map(VariedKeys::Several)
    }
}
