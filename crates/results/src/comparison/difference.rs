//! Differences as documents.

use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;

/// Two values that should be the same.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ValueDifference {
    /// Name of the series, or keys of the value in the report.
    pub series: String,
    /// What a value of a report is, in words: `check agreement, position, worst value`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
    /// The joint that it belongs to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// Simulated time, if the value has one.
    pub time_s: Option<f64>,
    /// The value in A; a number that JSON does not have is a word, `NaN` or `inf`, and a missing value is null.
    pub a: Value,
    /// The value in B, likewise.
    pub b: Value,
    /// B minus A; null unless both are finite numbers.
    pub difference: Option<f64>,
}

/// A series in which two runs differ.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SeriesDifference {
    /// Name of the series, as in the file.
    pub series: String,
    /// The unit of its values, if its name has one.
    #[serde(skip_serializing_if = "str::is_empty")]
    pub unit: &'static str,
    /// Number of times at which both have a value.
    pub compared: u64,
    /// Number of them at which the values differ.
    pub differing: u64,
    /// Number of times at which only A has a value.
    pub only_in_a: u64,
    /// Number of times at which only B has a value.
    pub only_in_b: u64,
    /// The first values that differ.
    pub first: Option<ValueDifference>,
    /// Those that differ most; a value that is no number in one of them counts as most.
    pub worst: Option<ValueDifference>,
}
