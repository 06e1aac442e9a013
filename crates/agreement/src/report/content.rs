//! What a diagnosis says, as programs read it.

use congruent_description::Diagnostic;
use serde::Serialize;

use super::values::ReportedValue;

/// One climb: two models of the chain from base to tip.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReportedDiagnosis {
    /// Which two: `model_urdf`, `model_simulation` or `urdf_simulation`.
    pub name: &'static str,
    /// The same in words.
    pub title: &'static str,
    /// The likeliest cause, then what comes next and leaves more; empty where they agree.
    pub diagnosis: Vec<ReportedCause>,
    /// Causes that leave as little as the first.
    pub indistinguishable: Vec<ReportedAlternative>,
    /// Screws and distances that differ, the most invariant first.
    pub invariants: Vec<ReportedDifference>,
    /// The first cause with its places in the robot file.
    #[serde(skip)]
    pub findings: Vec<Diagnostic>,
}

/// A cause with what it leaves.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReportedCause {
    /// What is wrong.
    #[serde(flatten)]
    pub fault: Fault,
    /// WorstDifference distance of the tips that is left.
    pub residual_m: f64,
    /// WorstDifference angle between the tips that is left.
    pub residual_rad: f64,
    /// The faults of `several`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<Fault>,
}

/// A cause that cannot be told from the first.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReportedAlternative {
    /// The cause.
    #[serde(flatten)]
    pub cause: ReportedCause,
    /// Why it is the same.
    pub reason: &'static str,
}

/// One fault: what, where, what stands there, what should.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Fault {
    /// The cause's stable name.
    pub cause: &'static str,
    /// The joint, where it is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// The joints, where they are several.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub joints: Vec<String>,
    /// `a`, `alpha`, `d`, `theta`, or several of them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub parameter: Option<String>,
    /// How far off: found less expected in rad or m; of a ratio or a column's unit, found by expected.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// What stands there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub found: Option<ReportedValue>,
    /// What should.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub expected: Option<ReportedValue>,
    /// Of a declared transform: found less expected.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub translation_m: Option<[f64; 3]>,
    /// Of a declared transform: the turn from expected to found, axis times angle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotation_rad: Option<[f64; 3]>,
    /// The file at fault: the robot file, or the URDF.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// Line in it, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<usize>,
    /// What to change.
    pub suggestion: String,
}

/// A quantity in which the chains differ.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReportedDifference {
    /// `kind`, `ratio`, `axis_distance`, `axis_angle`, `offset`, `sign`, `zero`, `base` or `tool`.
    pub invariant: &'static str,
    /// The joint; of consecutive axes the first.
    pub joint: String,
    /// Of the model; of `base` and `tool` the distance; `null` where it has no such quantity.
    pub found: f64,
    /// Of the other; `null` where it has no such quantity.
    pub expected: f64,
}
