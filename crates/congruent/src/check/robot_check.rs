//! The answer of `congruent check`: geometry, then dynamics.

use congruent_agreement::{
    SourcePair,
    compare::{Agreement, CheckReport, DifferenceAt, DifferencesAt},
    report::ReportedDiagnosis,
};
use congruent_description::RobotDescription;
use congruent_dynamics_agreement::{DynamicsReport, DynamicsVerdict};
use congruent_lint_report::LintSummary;
use schemars::JsonSchema;
use serde::Serialize;

use super::{
    against::OtherDescription, change::RevisionChange, declared::DeclaredSource, loaded_words::LoadedKind,
};

/// The answer of `congruent check` for one robot.
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(rename = "CheckReport")]
pub struct RobotCheck {
    /// Poses of table, URDF, screws and physics. Its `verdict` and `not_asked` are those of the whole check.
    #[serde(flatten)]
    pub geometry: CheckReport,
    /// The worst of all comparisons at each requested configuration.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Vec<DifferenceAt>", default)]
    pub at_configurations: Option<DifferencesAt>,
    /// The other description, of --against.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub against: Option<OtherDescription>,
    /// What has changed since the revision of --against.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub change: Option<RevisionChange>,
    /// The dynamics that the robot file declares.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub declared_dynamics: Option<DeclaredSource>,
    /// The comparison of masses, inertias, joint terms, gravity and limits that matters most: the first that disagrees;
    /// if all agree that of two descriptions, and without a second one that of the URDF and the physics. `null` if none
    /// could be made.
    pub dynamics: Option<DynamicsReport>,
    /// The other comparisons of dynamics.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub other_dynamics: Vec<DynamicsReport>,
    /// What lint finds in the descriptions: values that are suspicious whatever they are compared with.
    pub lint: LintSummary,
    /// The two descriptions as they were compared, if joints are called or counted otherwise in the other.
    #[serde(skip)]
    pub mapped: Option<Box<[RobotDescription; 2]>>,
    /// The robot's own file, if --against names it: it is no second description.
    #[serde(skip)]
    pub itself: Option<String>,
    /// Line of the robot file that declares the tolerance, if one does.
    #[serde(skip)]
    pub tolerance_line: Option<usize>,
    /// What --fix has written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fix: Option<WrittenFix>,
}

/// The corrected robot file that `check --fix` writes, and its own check.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct WrittenFix {
    /// The file; missing if none was written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// The verdict of the check of that file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub verdict: Option<Agreement>,
    /// The answer of that check in a sentence, or why nothing was written.
    pub statement: String,
}

impl RobotCheck {
    /// What the other description is if it is no file.
    pub(crate) fn loaded(&self) -> Option<LoadedKind> {
        self.against.as_ref()?.loaded
    }

    /// All comparisons of dynamics.
    pub fn all_dynamics(&self) -> impl Iterator<Item = &DynamicsReport> {
        self.dynamics.iter().chain(&self.other_dynamics)
    }

    /// The comparisons of two descriptions of the dynamics.
    pub fn dynamics_of_descriptions(&self) -> impl Iterator<Item = &DynamicsReport> {
        self.all_dynamics().filter(|report| !report.is_of_physics())
    }

    /// The URDF against the physics that was built from it: whether that was built right.
    pub fn dynamics_of_physics(&self) -> Option<&DynamicsReport> {
        self.all_dynamics().find(|report| report.is_of_physics())
    }

    /// Whether findings of lint fail the check, by --strict.
    pub fn fails_by_lint(&self) -> bool {
        self.lint.is_strict && self.lint.findings() > 0
    }

    /// Whether there is neither a second description of the geometry nor one of the dynamics: physics and screws are made of
    /// the URDF.
    pub fn lacks_second_description(&self) -> bool {
        let has_geometry = self.geometry.table_compared || self.against.is_some();
        !has_geometry && self.dynamics_of_descriptions().all(|of| of.verdict == DynamicsVerdict::NotCompared)
    }

    /// Whether the missing second description fails a check that agrees otherwise, by --strict.
    pub fn fails_without_second(&self) -> bool {
        self.lint.is_strict && self.geometry.verdict == Agreement::Agree && self.lacks_second_description()
    }

    /// Whether nothing else differs than that masses or losses of one description cannot be read.
    pub fn is_unreadable(&self) -> bool {
        let is_unreadable = self.against.as_ref().is_some_and(|against| against.is_unreadable);
        is_unreadable && !self.geometry.poses_disagree()
    }

    /// The other description with the reason why nothing of the two was compared: they have other joints.
    pub(super) fn other_chain(&self) -> Option<(&OtherDescription, &str)> {
        let against = self.against.as_ref()?;
        let mut compared = self.geometry.comparisons.iter().map(|of| of.name);
        let why = against.dynamics_not_compared.as_ref()?;
        (!compared.any(|name| name == SourcePair::UrdfOther)).then_some((against, why))
    }

    /// The diagnosis that is reported: the first that names a cause.
    pub fn diagnosis(&self) -> Option<&ReportedDiagnosis> {
        self.geometry.diagnoses.iter().find(|diagnosis| !diagnosis.causes.is_empty())
    }
}
