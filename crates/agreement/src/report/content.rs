//! The diagnosis as programs read it.

use congruent_description::Diagnostic;
use schemars::JsonSchema;
use serde::Serialize;

use super::values::ReportedValue;
use crate::{
    diagnosis::{Cause, Equivalence, Invariant},
    source_pair::SourcePair,
};

/// The diagnosis of one pair of models of the chain from base to tip.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReportedDiagnosis {
    /// The pair: `model_urdf`, `model_simulation` or `urdf_simulation`.
    pub name: SourcePair,
    /// The pair in words.
    pub title: &'static str,
    /// The likeliest cause, then the next best ones, with larger residuals; empty if the models agree.
    pub causes: Vec<ReportedCause>,
    /// Causes with a residual as small as the first one's.
    pub indistinguishable: Vec<ReportedAlternative>,
    /// Screws and distances that differ, the most invariant first.
    pub invariants: Vec<ReportedDifference>,
    /// The first cause with its places in the robot file.
    #[serde(skip)]
    pub findings: Vec<Diagnostic>,
}

/// A cause with the residual after it is corrected.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReportedCause {
    /// What is wrong.
    #[serde(flatten)]
    pub fault: Fault,
    /// The largest remaining distance of the tips, m.
    pub residual_m: f64,
    /// The largest remaining angle between the tips, rad.
    pub residual_rad: f64,
    /// The faults of `several`.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub parts: Vec<Fault>,
}

/// A cause that cannot be distinguished from the first.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReportedAlternative {
    /// The cause.
    #[serde(flatten)]
    pub cause: ReportedCause,
    /// Why the two cannot be distinguished.
    pub equivalence: Equivalence,
    /// The same in words.
    pub reason: &'static str,
}

/// One fault: the cause, the place, the found and the expected value.
#[derive(Debug, Clone, PartialEq, Default, Serialize, JsonSchema)]
pub struct Fault {
    /// The cause.
    pub cause: Cause,
    /// The joint, if it is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// The joints, if they are several.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub joints: Vec<String>,
    /// `a`, `alpha`, `d`, `theta`, `kind`, `rpy`, or several of them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub parameter: Option<String>,
    /// The error: found minus expected in rad or m; of a ratio or a column's unit, found divided by expected.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// The value in the file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub found: Option<ReportedValue>,
    /// The correct value.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub expected: Option<ReportedValue>,
    /// Of a declared transform: found minus expected, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub translation_m: Option<[f64; 3]>,
    /// Of a declared transform: the rotation from expected to found, axis times angle, rad.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotation_rad: Option<[f64; 3]>,
    /// The file with the fault: the robot file or the URDF.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// Line in the file, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<usize>,
    /// What to change.
    pub suggestion: String,
}

/// A quantity in which the chains differ.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReportedDifference {
    /// The quantity.
    pub invariant: Invariant,
    /// The joint; of consecutive axes the first.
    pub joint: String,
    /// Its value in the first model; of `base` and `tool` the distance of the two models; `null` if the model
    /// does not have it.
    pub found: f64,
    /// Its value in the second model; `null` if the model does not have it.
    pub expected: f64,
}
