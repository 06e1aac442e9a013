//! The answer of `congruent check`.

use std::fmt;

use congruent_description::{JointValues, ReportedChain, RequestedTolerance, Tolerance};
use congruent_input::{Diagnostic, Finding, serde_name};
use congruent_kinematics::{PoseError, ReportedPose};
use schemars::JsonSchema;
use serde::Serialize;

use super::{
    basics::Basics,
    certificate::{Brackets, ReportedCertificate},
    grade::Grade,
    model::PoseSource,
};
use crate::{
    report::{ReportedAlternative, ReportedCause, ReportedDiagnosis},
    source_pair::SourcePair,
};

/// Whether sources describe the same robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Agreement {
    /// Within tolerance at every configuration.
    Agree,
    /// Beyond the tolerance at one configuration or more.
    Disagree,
    /// There is one description of the robot and nothing to compare it with: no table, and the physics could not be
    /// compared; or nothing moves.
    NothingCompared,
}

impl Agreement {
    /// Why nothing was compared.
    pub fn why_nothing(chain: &ReportedChain) -> &'static str {
        if chain.joints.is_empty() {
            "no joint moves between base and tip"
        } else {
            "there is no [dh] table, and the physics was not compared"
        }
    }
}

impl fmt::Display for Agreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

/// The largest differences, in position and in orientation; the two may be at different configurations.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct WorstDifference {
    /// The largest distance and the largest angle at a link.
    #[serde(flatten)]
    pub error: PoseError,
    /// The link with the largest distance.
    pub link: String,
    /// The configuration of the largest distance: every movable joint, rad or m.
    pub at: JointValues,
    /// The positions there of joints that follow another one in one of two descriptions alone, rad or m: as the other description has
    /// them.
    #[serde(skip_serializing_if = "JointValues::is_empty")]
    pub at_in_other: JointValues,
}

/// The comparison of two sources.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Comparison {
    /// The pair: `model_urdf`, `poe_urdf`, `urdf_simulation`, `urdf_other` or `other_model_urdf`.
    pub name: SourcePair,
    /// The pair in words.
    pub title: &'static str,
    /// Whether the links that decide the verdict are within the tolerance.
    pub verdict: Agreement,
    /// The largest differences over the links that decide the verdict.
    pub worst: WorstDifference,
    /// The largest difference at each link, in the order of the URDF.
    pub links: Vec<LinkDifference>,
}

/// The largest difference at one link.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct LinkDifference {
    /// Name of the link.
    pub link: String,
    /// The origin of the first source's pose.
    pub source: PoseSource,
    /// The largest distance and the largest angle.
    #[serde(flatten)]
    pub error: PoseError,
}

/// A source of poses or torques that a check may be unable to compare.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ComparedSource {
    /// Poses of the physics.
    Simulation,
    /// Accelerations of the physics under torques.
    SimulatedDynamics,
    /// The inertias that the robot file declares.
    DeclaredDynamics,
    /// The inertias of another URDF.
    OtherDynamics,
    /// A second description of the geometry, which the caller does not have.
    Geometry,
    /// A second description of the dynamics, which the caller does not have.
    Dynamics,
}

impl ComparedSource {
    /// The name in reports.
    pub fn name(self) -> &'static str {
        serde_name(&self)
    }
}

/// A source that could not be compared.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct NotCompared {
    /// The source: `simulation`, `simulated_dynamics`, `declared_dynamics` or `other_dynamics`; `geometry` or `dynamics` if
    /// there is one description alone.
    #[schemars(with = "String")]
    pub source: ComparedSource,
    /// The reasons why it was not compared.
    pub findings: Vec<Finding>,
}

impl NotCompared {
    /// A source that could not be compared for one reason.
    pub fn because(source: ComparedSource, finding: &Diagnostic) -> Self {
        Self { source, findings: vec![Finding::from(finding)] }
    }
}

/// The answer of `congruent check` for one robot.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct CheckReport {
    /// The robot file, or the URDF if there is none.
    pub file: String,
    /// Name of the robot.
    pub robot: String,
    /// Base and tip, and who named them.
    pub chain: ReportedChain,
    /// Number of all moving joints of the robot, mimic joints included. A table is compared over those of `chain`.
    pub robot_joints: usize,
    /// Whether a table was compared; if not, the URDF, its screws and the physics are compared with each other.
    pub table_compared: bool,
    /// Whether all sources that were compared agree.
    pub verdict: Agreement,
    /// How much alike the poses of the sources are, whatever the tolerance is; missing if none were compared. Masses and limits
    /// have no part in it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grade: Option<Grade>,
    /// The largest difference that the digits of two files allow, to first order: the sum of what half of the last place of each
    /// typed value moves the tip, of two descriptions without a table each link. Missing if the two are identical.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub allowed_by_digits: Option<PoseError>,
    /// The largest differences of all comparisons.
    pub worst: WorstDifference,
    /// The largest difference that counts as agreement.
    pub tolerance: Tolerance,
    /// Whether the robot file or the caller has declared a tolerance; if not, the digits of table and URDF decide.
    pub tolerance_is_declared: bool,
    /// The parts of the tolerance that are declared; the digits of table and URDF decide the others.
    pub declared_tolerance: RequestedTolerance,
    /// The tolerance that the caller gave in place of the robot file's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub requested_tolerance: Option<RequestedTolerance>,
    /// The tolerance that the robot file declares, if the caller checked with another one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub replaced_tolerance: Option<Tolerance>,
    /// Number of configurations: zero, single axes, random ones, limits, the worst one of each certificate,
    /// and those that were requested.
    pub configurations: usize,
    /// Seed of the random ones.
    pub seed: u64,
    /// The comparisons, two sources each.
    pub comparisons: Vec<Comparison>,
    /// First checks: zero, one axis at a time, whether the transforms are rigid motions.
    pub basics: Basics,
    /// Bound of the difference of the models over the whole joint range: the largest of `certificates`.
    pub certificate: Option<PoseError>,
    /// The same bounds with the configurations that come nearest to them.
    pub certificate_bracket: Option<Brackets>,
    /// The certificates, two models of the chain each.
    pub certificates: Vec<ReportedCertificate>,
    /// The likeliest cause of a disagreement, then the next best ones: those of the first of `diagnoses`
    /// that has any.
    pub diagnosis: Vec<ReportedCause>,
    /// Causes that cannot be distinguished from the first one.
    pub indistinguishable: Vec<ReportedAlternative>,
    /// The diagnoses, two models of the chain each.
    pub diagnoses: Vec<ReportedDiagnosis>,
    /// Sources that could not be compared: the verdict says nothing about them.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub not_asked: Vec<NotCompared>,
    /// Warnings about the input.
    pub warnings: Vec<Finding>,
}

/// The tip by two sources, in link `base`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct TipDifference {
    /// The pair: `model_urdf`, `urdf_simulation` or `urdf_other`.
    pub pair: SourcePair,
    /// Pose of the tip by the first source of the pair.
    pub first: ReportedPose,
    /// Pose of the tip by the second.
    pub second: ReportedPose,
    /// Distance and angle between the two.
    #[serde(flatten)]
    pub error: PoseError,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_verdict_prints_as_it_is_serialised_and_fills_a_column() {
        assert_eq!(format!("{:9}|", Agreement::Agree), "agree    |");
        assert_eq!(serde_json::to_value(Agreement::Disagree).unwrap(), "disagree");
    }

    /// The schema names causes and pairs as the report does.
    #[test]
    fn a_report_has_a_schema() {
        let schema = serde_json::to_string(&schemars::schema_for!(CheckReport)).unwrap();
        for word in ["axis_flipped", "model_urdf", "within_tolerance", "axis_distance"] {
            assert!(schema.contains(&format!("\"{word}\"")), "no {word} in {schema}");
        }
    }
}
