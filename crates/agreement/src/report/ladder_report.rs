//! What the ladder found, as programs read it and as a compiler would say it.

use congruent_description::Diagnostic;
use serde::Serialize;

use super::{
    blame::{Accusation, Spot, accuse},
    figures::{Figure, angle, length},
    ladder::{Names, Title},
};
use crate::diagnosis::{Case, Cause, Diagnosis, Explanation, JointDifference};

/// One climb: two models of the chain from base to tip.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Ladder {
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
    pub blame: Blame,
    /// Worst distance of the tips that is left.
    pub residual_m: f64,
    /// Worst angle between the tips that is left.
    pub residual_rad: f64,
    /// The faults of `several`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<Blame>,
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
pub struct Blame {
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
    pub found: Option<Figure>,
    /// What should.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub expected: Option<Figure>,
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

pub(super) fn ladder(title: Title, case: &Case, diagnosis: &Diagnosis, names: &Names<'_>) -> Ladder {
    let told: Vec<(ReportedCause, Vec<Diagnostic>)> =
        diagnosis.explanations.iter().map(|explanation| tell(case, explanation, names)).collect();
    let findings = told.first().map(|(_, findings)| findings.clone()).unwrap_or_default();
    let alternative = |(explanation, gauge): &(Explanation, crate::diagnosis::Gauge)| ReportedAlternative {
        cause: tell(case, explanation, names).0,
        reason: gauge.sentence(),
    };
    Ladder {
        name: title.name,
        title: title.title,
        diagnosis: told.into_iter().map(|(cause, _)| cause).collect(),
        indistinguishable: diagnosis.indistinguishable.iter().map(alternative).collect(),
        invariants: diagnosis.differences.iter().map(|each| difference(each, names)).collect(),
        findings,
    }
}

fn tell(case: &Case, explanation: &Explanation, names: &Names<'_>) -> (ReportedCause, Vec<Diagnostic>) {
    let accusations: Vec<Accusation> =
        explanation.parts.iter().map(|part| accuse(part, case, &explanation.mended, names)).collect();
    let residual = explanation.residual;
    let left = format!("that leaves {} and {}", length(residual.position_m), angle(residual.orientation_rad));
    let findings = accusations.iter().map(|accusation| finding(accusation, &left)).collect();
    let mut parts: Vec<Blame> = accusations.into_iter().map(|accusation| accusation.blame).collect();
    let located = parts.iter().find(|part| part.line.is_some());
    let blame = match parts.len() {
        0 => Blame {
            cause: Cause::Unexplained.name(),
            suggestion: "nothing in the catalogue explains it: see `invariants` for where the screws differ"
                .into(),
            ..Blame::default()
        },
        1 => parts.remove(0),
        _ => Blame {
            cause: Cause::Several.name(),
            joints: involved(&parts),
            file: located.and_then(|part| part.file.clone()),
            line: located.and_then(|part| part.line),
            suggestion: parts.iter().map(|part| part.suggestion.as_str()).collect::<Vec<_>>().join("; "),
            ..Blame::default()
        },
    };
    let cause = ReportedCause {
        blame,
        residual_m: residual.position_m,
        residual_rad: residual.orientation_rad,
        parts,
    };
    (cause, findings)
}

fn involved(parts: &[Blame]) -> Vec<String> {
    let mut joints: Vec<String> =
        parts.iter().flat_map(|part| part.joint.iter().chain(&part.joints)).cloned().collect();
    joints.sort();
    joints.dedup();
    joints
}

/// A fault as a finding about its file.
fn finding(accusation: &Accusation, left: &str) -> Diagnostic {
    let Accusation { blame, message, spot, .. } = accusation;
    let finding = Diagnostic::error(accusation.code(), message.clone())
        .with_help(format!("{}; {left}", blame.suggestion));
    match spot {
        Some(Spot { source, span }) => finding.at(span.clone()).in_file(source),
        None => finding,
    }
}

fn difference(difference: &JointDifference, names: &Names<'_>) -> ReportedDifference {
    let JointDifference { invariant, joint, found, expected } = *difference;
    ReportedDifference { invariant: invariant.name(), joint: names.moving_joint(joint), found, expected }
}

impl Names<'_> {
    /// Name of a moving joint of the chain.
    pub(super) fn moving_joint(&self, joint: usize) -> String {
        let name = |&index| self.description.robot.joint(index).name.clone();
        self.moving.get(joint).map(name).unwrap_or_default()
    }

    /// Name of any joint of the chain.
    pub(super) fn chain_joint(&self, joint: usize) -> String {
        let name = |&index| self.description.robot.joint(index).name.clone();
        self.chain.get(joint).map(name).unwrap_or_default()
    }
}
