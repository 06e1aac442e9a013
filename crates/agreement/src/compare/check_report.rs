//! The answer of `congruent check`.

use congruent_description::{Finding, JointValues, Tolerance};
use congruent_kinematics::PoseError;
use serde::Serialize;

use super::{
    basics::Basics,
    certificate::{Brackets, ReportedCertificate},
    model::PoseSource,
};
use crate::report::{ReportedAlternative, ReportedCause, ReportedDiagnosis};

/// Whether sources tell of the same robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Agreement {
    /// Within tolerance at every configuration.
    Agree,
    /// Beyond tolerance somewhere.
    Disagree,
}

/// The largest differences with their places; the two need not be at the same configuration.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WorstDifference {
    /// The largest distance and the largest angle at a link.
    #[serde(flatten)]
    pub error: PoseError,
    /// The link that is furthest off in position.
    pub link: String,
    /// The configuration at which it is: every movable joint, rad or m.
    pub at: JointValues,
}

/// Two sources against each other.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Comparison {
    /// Which two: `model_urdf`, `poe_urdf` or `urdf_simulation`.
    pub name: &'static str,
    /// The same in words.
    pub title: &'static str,
    /// Whether the links that decide are within tolerance.
    pub verdict: Agreement,
    /// The worst over the links that decide.
    pub worst: WorstDifference,
    /// The worst at each link.
    pub links: Vec<LinkDifference>,
}

/// The largest difference at one link.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LinkDifference {
    /// The link.
    pub link: String,
    /// Where the first source's pose comes from.
    pub source: PoseSource,
    /// The largest distance and the largest angle.
    #[serde(flatten)]
    pub error: PoseError,
}

/// The answer of `congruent check` for one robot.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CheckReport {
    /// Name of the robot.
    pub robot: String,
    /// Whether all sources agree.
    pub verdict: Agreement,
    /// The worst of all comparisons.
    pub worst: WorstDifference,
    /// When two poses count as the same.
    pub tolerance: Tolerance,
    /// Number of configurations: zero, single axes, random ones, limits, the worst of each certificate.
    pub configurations: usize,
    /// Seed of the random ones.
    pub seed: u64,
    /// Two sources at a time.
    pub comparisons: Vec<Comparison>,
    /// The worst of all comparisons at each configuration that was asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub at_configurations: Vec<DifferenceAt>,
    /// What a person tries first: zero, one axis at a time, whether the transforms are rigid.
    pub basics: Basics,
    /// How far models are apart at most, over the whole joint range: the largest of `certificates`.
    pub certificate: Option<PoseError>,
    /// The same with configurations that come near.
    pub certificate_bracket: Option<Brackets>,
    /// Two models of the chain at a time.
    pub certificates: Vec<ReportedCertificate>,
    /// The likeliest cause of a disagreement, then what comes next and leaves more: that of the
    /// first of `diagnoses` that has one.
    pub diagnosis: Vec<ReportedCause>,
    /// Causes that leave as little as the first.
    pub indistinguishable: Vec<ReportedAlternative>,
    /// The diagnosis of two models of the chain at a time.
    pub diagnoses: Vec<ReportedDiagnosis>,
    /// What was suspicious in the input.
    pub warnings: Vec<Finding>,
}

/// How far sources are apart at one configuration that was asked for.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DifferenceAt {
    /// The configuration: every movable joint, rad or m.
    pub q: JointValues,
    /// The largest distance and the largest angle at a link that decides.
    #[serde(flatten)]
    pub error: PoseError,
}
