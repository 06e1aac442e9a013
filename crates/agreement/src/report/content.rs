//! The diagnosis as programs read it.

use congruent_description::{ChangedLines, Diagnostic};
use congruent_kinematics::PoseError;
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
    /// The pair: `model_urdf`, `model_simulation`, `urdf_simulation` or `urdf_other`.
    pub name: SourcePair,
    /// The pair in words.
    pub title: &'static str,
    /// The likeliest cause, then the next best ones, with larger residuals; empty if the models agree.
    pub causes: Vec<ReportedCause>,
    /// Causes with a residual as small as the first one's.
    pub indistinguishable: Vec<ReportedAlternative>,
    /// Screws and distances that differ, the most invariant first.
    pub invariants: Vec<ReportedDifference>,
    /// The table beside the nearest one that agrees, row by row, if no cause explains everything.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub table: Option<TableComparison>,
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
    /// Whether that is within the tolerance: the cause explains the whole difference.
    pub within_tolerance: bool,
    /// The faults of `several`, the one with the largest effect first.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub parts: Vec<Fault>,
    /// The difference before and after each fault is corrected, one after the other: of each of `parts`, or
    /// of the only fault.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub stages: Vec<ReportedStage>,
}

/// The difference of the tips before and after a fault is corrected.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct ReportedStage {
    /// With all faults before it corrected.
    pub before: PoseError,
    /// With this fault corrected as well.
    pub after: PoseError,
}

/// The given table beside the one that agrees and is nearest to it.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct TableComparison {
    /// The largest remaining difference of the nearest table.
    pub residual: PoseError,
    /// All values of the table, row by row, then those of the declared transforms.
    pub values: Vec<ComparedValue>,
}

/// One value of the table.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ComparedValue {
    /// The joint of the row; left out for a declared transform.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// The key as the robot file has it.
    pub key: String,
    /// The value as the file writes it.
    pub found: String,
    /// The same of the nearest table that agrees.
    pub expected: String,
    /// Whether the two differ.
    pub differs: bool,
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
    /// `a`, `alpha`, `d`, `theta`, `kind`, `rpy`, `xyz`, or several of them.
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
    /// Of a declared transform, or of the origin of a joint: found minus expected, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub translation_m: Option<[f64; 3]>,
    /// Of a declared transform, or of the origin or the axis of a joint: the rotation from expected to found, axis times
    /// angle, rad.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotation_rad: Option<[f64; 3]>,
    /// The file with the fault: the robot file or the URDF.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// Line in the file, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<usize>,
    /// Of a joint of two URDFs: the other file, if one of its joints has the expected value.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub expected_file: Option<String>,
    /// Line in that file, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub expected_line: Option<usize>,
    /// The fault in words.
    pub message: String,
    /// What to change: whole lines of the robot file, or a sentence if the file cannot say it.
    pub suggestion: String,
    /// The lines of the robot file that change, with what they become.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub changes: Vec<ChangedLines>,
    /// The new lines to paste, with a comment that says where.
    #[serde(skip)]
    pub pasted: Vec<String>,
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
