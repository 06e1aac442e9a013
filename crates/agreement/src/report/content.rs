//! The diagnosis as programs read it.

use congruent_input::{
    ChangedLines, Diagnostic, PastedLines, SourceFile, TextEdit, edited, toml_text::is_toml,
};
use congruent_kinematics::PoseError;
use schemars::JsonSchema;
use serde::{Serialize, Serializer};

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
    /// Causes that cannot be distinguished from the first one.
    pub indistinguishable: Vec<ReportedAlternative>,
    /// Screws and distances that differ, the most invariant first.
    pub invariants: Vec<ReportedDifference>,
    /// The table beside the nearest one that agrees, row by row, if no cause explains everything.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub table: Option<TableComparison>,
    /// The robot file with the first cause corrected, or with the first of `indistinguishable` that a robot file can
    /// hold; missing if it can hold none of them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corrected: Option<CorrectedFile>,
    /// The first cause with its places in the robot file.
    #[serde(skip)]
    pub findings: Vec<Diagnostic>,
}

/// A robot file with every line of a correction.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct CorrectedFile {
    /// The robot file that has the cause.
    pub file: String,
    /// The whole text with the correction.
    pub text: String,
}

impl CorrectedFile {
    pub(super) fn new(source: &SourceFile, edits: &[TextEdit]) -> Self {
        Self { file: source.path.display().to_string(), text: edited(&source.text, edits) }
    }

    /// The table in it: `[dh]` with all rows and declared transforms.
    pub fn table(&self) -> String {
        congruent_description::dh_text(&self.text)
    }
}

/// A cause with the residual after it is corrected.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReportedCause {
    /// Cause, place, found and expected value; of several faults the summary.
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
    /// The difference before and after the correction of each fault, one after the other: for each of `parts`, or
    /// for the only fault.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub stages: Vec<ReportedStage>,
}

/// The difference of the tips before and after a fault is corrected.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct ReportedStage {
    /// The difference with all faults before this one corrected.
    pub before: PoseError,
    /// The difference with this fault corrected, too.
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
    /// The joint of the row; missing for a declared transform.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// The key as the robot file has it.
    pub key: String,
    /// The value as the file writes it.
    pub found: String,
    /// The value in the nearest table that agrees.
    pub expected: String,
    /// Whether the two differ.
    pub differs: bool,
}

/// A cause that cannot be distinguished from the first.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReportedAlternative {
    /// The other cause, with its residual.
    #[serde(flatten)]
    pub cause: ReportedCause,
    /// Why the two cannot be distinguished.
    pub equivalence: Equivalence,
    /// The reason as a sentence.
    pub reason: &'static str,
}

/// One fault: the cause, the place, the found and the expected value.
#[derive(Debug, Clone, PartialEq, Default, Serialize, JsonSchema)]
pub struct Fault {
    /// Name of the cause; `unexplained` if none of the known ones fits.
    pub cause: Cause,
    /// Name of the joint, if the fault is in one joint.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// Names of the joints, if the fault is in several.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub joints: Vec<String>,
    /// `a`, `alpha`, `d`, `theta`, `kind`, `rpy`, `xyz`, or several of them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub parameter: Option<String>,
    /// The error: found minus expected, rad or m; for a ratio or the unit of a column, found divided by expected.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// The value in the file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub found: Option<ReportedValue>,
    /// The value with which the models agree, in the unit of `found`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub expected: Option<ReportedValue>,
    /// Translation error of a declared transform or of a joint origin: found minus expected, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub translation_m: Option<[f64; 3]>,
    /// Rotation error of a declared transform, a joint origin or a joint axis: from expected to found, axis times
    /// angle, rad.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotation_rad: Option<[f64; 3]>,
    /// The file with the fault: the robot file or the URDF.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// Line in the file, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<usize>,
    /// The other URDF, if one of its joints has the expected value.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub expected_file: Option<String>,
    /// Line in that file, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub expected_line: Option<usize>,
    /// The fault in words.
    pub message: String,
    /// What to change: whole lines of the file, those of several rows one below the other. Advice in words, if the file has no
    /// key for it, is a comment of TOML in JSON.
    #[serde(serialize_with = "words_as_comments")]
    pub suggestion: String,
    /// The lines of the robot file that change, with their new text.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub changes: Vec<ChangedLines>,
    /// The new lines to paste, and where.
    #[serde(skip)]
    pub pasted: Vec<PastedLines>,
}

/// Lines of files as they are, and words behind `#`, so that no program pastes words into a file.
fn words_as_comments<S: Serializer>(suggestion: &str, serializer: S) -> Result<S::Ok, S::Error> {
    // A row of a list in one line, and a line of a URDF.
    let is_of_file = |line: &str| line.trim_start().starts_with(['{', '<']) || is_toml(line);
    let comment = |line: &str| if is_of_file(line) { line.to_owned() } else { format!("# {line}") };
    serializer.serialize_str(&suggestion.lines().map(comment).collect::<Vec<_>>().join("\n"))
}

/// A quantity in which the chains differ.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReportedDifference {
    /// The quantity that differs: a distance, m, an angle, rad, a ratio or a class.
    pub invariant: Invariant,
    /// Name of the joint; for consecutive axes the first.
    pub joint: String,
    /// Value in the first model; for `base` and `tool` the distance of the two models; `null` if the model does not
    /// have it.
    pub found: f64,
    /// Value in the second model; `null` if the model does not have it.
    pub expected: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn advice_in_words_is_a_comment_for_programs() {
        let fault = Fault {
            suggestion: "a_m = 0.4\nmove each value of a one row up\n{ joint = \"a\", a_m = 1 },".to_owned(),
            ..Fault::default()
        };
        let written = serde_json::to_value(&fault).unwrap();
        let expected = "a_m = 0.4\n# move each value of a one row up\n{ joint = \"a\", a_m = 1 },";
        assert_eq!(written["suggestion"], expected);
        assert!(fault.suggestion.contains("\nmove"), "people read it without the sign");
    }
}
