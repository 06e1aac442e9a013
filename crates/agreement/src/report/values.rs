//! Values in the form that reports need.

use schemars::JsonSchema;
use serde::Serialize;

/// A found or expected value.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum ReportedValue {
    /// A number in rad, m, or without unit.
    Number(f64),
    /// Several numbers with their keys, or a word.
    Text(String),
}
