//! The comparison of model, URDF and physics without motion: are they the same robot?

use std::sync::Arc;

use congruent_description::{RobotDescription, RobotQ, RobotQList, Tolerance};
use congruent_input::{Finding, Findings, display::quantity};
use congruent_kinematics::{LinkPoses, PoseError, ScrewChain, sample_configurations};

use super::{
    basics::basics,
    certificate::{Brackets, ReportedCertificate, certificates, worst},
    check_report::{Agreement, CheckReport, ComparedSource, Comparison, NotCompared, WorstDifference},
    comparing::{Comparing, is_turned_only},
    configurations::CheckConfigurations,
    error::CheckError,
    grade::Grade,
    graded::Graded,
    identified::IdentifiedChain,
};
use crate::{
    report::{ReportedDiagnosis, diagnose_models},
    source_pair::SourcePair,
};

/// Which configurations a check compares, in addition to those at zero, on single axes and at limits.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CheckOptions {
    /// Seed of the random configurations.
    pub seed: u64,
    /// Requested configurations of the whole robot, compared in addition.
    pub configurations: Arc<RobotQList>,
}

/// Number of random configurations of a check.
pub const RANDOM_CONFIGURATIONS: usize = 200;

/// Compares model, URDF chain, screws and physics.
///
/// The verdict on the model depends on link `tip`, whose constants are declared. Links in between are
/// compared with a fitted constant and only shown; they follow from the tip: two chains that agree at the
/// tip for every configuration have the same axes.
///
/// `physics` may be the findings that prevent its use: the other sources are then compared, and the report lists
/// the findings.
///
/// # Errors
/// [`CheckError`] if a source rejects the robot.
pub fn check(
    description: &RobotDescription,
    physics: Result<&mut dyn LinkPoses, Findings>,
    options: &CheckOptions,
) -> Result<CheckReport, CheckError> {
    let ComparedSources { mut report, identified, diagnosed } = compared(description, physics, options)?;
    report.set_diagnoses(diagnose_models(description, identified.as_ref(), &diagnosed));
    Ok(report)
}

/// A report without a diagnosis, and the input of a diagnosis.
pub(super) struct ComparedSources {
    pub(super) report: CheckReport,
    /// The chain of the physics.
    pub(super) identified: Option<ScrewChain>,
    /// The configurations at which causes are judged; none if the sources agree.
    pub(super) diagnosed: Vec<RobotQ>,
}

/// The comparisons of [`check`], without the cause of a difference.
pub(super) fn compared(
    description: &RobotDescription,
    physics: Result<&mut dyn LinkPoses, Findings>,
    options: &CheckOptions,
) -> Result<ComparedSources, CheckError> {
    let robot = &description.robot;
    resolved(description, &options.configurations)?;
    // First the configurations that every robot gets: zero, single axes, limits, random ones.
    let mut configurations = sample_configurations(robot, options.seed, RANDOM_CONFIGURATIONS);
    let Physics { source, identified, certificates, not_asked } =
        Physics::new(description, physics, &configurations)?;
    let mut comparing = Comparing::new(description, source.map(|source| Box::new(source) as _))?;
    // The worst configurations of the certificates count for the verdict: random ones seldom find them.
    let brackets = certificates.iter().filter_map(|certificate| certificate.brackets.as_ref());
    configurations.extend(brackets.flat_map(|brackets| brackets.attained_at(robot)));
    let configurations = CheckConfigurations { sampled: configurations, requested: &options.configurations };
    for (index, q) in configurations.iter().enumerate() {
        comparing.observe(index, &q)?;
    }
    let mut comparisons = comparing.finish(description, |index| configurations.at(index));
    let Graded { grade, allowed_by_digits } =
        Graded::new(description, &mut comparisons, || configurations.diagnosed(comparing.worst_at()));
    let verdict = verdict(&comparisons);
    // If all sources agree, the residual is the rounding of the identified screws, which has no cause.
    let diagnosed = match verdict {
        Agreement::Agree => Vec::new(),
        _ => configurations.diagnosed(comparing.worst_at()),
    };
    let brackets = worst(&certificates);
    let report = CheckReport {
        file: description.path.display().to_string(),
        robot: description.name.clone(),
        chain: description.reported_chain(),
        robot_joints: description.robot.joints().iter().filter(|joint| joint.kind.is_movable()).count(),
        table_compared: description.dh.is_some(),
        verdict,
        grade: (verdict != Agreement::NothingCompared).then_some(grade),
        allowed_by_digits,
        worst: worst_difference(&comparisons, &description.tolerance),
        tolerance: description.tolerance,
        tolerance_is_declared: description.declared_tolerance.is_declared(),
        declared_tolerance: description.declared_tolerance,
        requested_tolerance: None,
        replaced_tolerance: None,
        configurations: configurations.len(),
        seed: options.seed,
        comparisons,
        basics: basics(description, configurations.iter())?,
        certificate: brackets.as_ref().map(Brackets::bounds),
        certificate_bracket: brackets,
        certificates,
        diagnosis: Vec::new(),
        indistinguishable: Vec::new(),
        diagnoses: Vec::new(),
        not_asked,
        warnings: description.warnings.iter().map(Finding::from).collect(),
    };
    Ok(ComparedSources { report, identified, diagnosed })
}

impl CheckReport {
    /// Sets the diagnoses; the first one with a cause is that of the report.
    pub fn set_diagnoses(&mut self, diagnoses: Vec<ReportedDiagnosis>) {
        let named = diagnoses.iter().find(|diagnosis| !diagnosis.causes.is_empty());
        self.diagnosis = named.map(|diagnosis| diagnosis.causes.clone()).unwrap_or_default();
        self.indistinguishable =
            named.map(|diagnosis| diagnosis.indistinguishable.clone()).unwrap_or_default();
        self.diagnoses = diagnoses;
    }

    /// A pair of sources as its comparison calls it, which says what the files are.
    pub fn title(&self, pair: SourcePair) -> &'static str {
        let known = self.comparisons.iter().find(|comparison| comparison.name == pair);
        known.map_or_else(|| pair.title(), |comparison| comparison.title)
    }

    /// Adds the comparisons of two further sources with what their digits allow, and the grade of these.
    pub fn add_comparisons(
        &mut self,
        found: Vec<Comparison>,
        grade: Option<Grade>,
        allowed_by_digits: Option<PoseError>,
    ) {
        self.comparisons.extend(found);
        self.worst = worst_difference(&self.comparisons, &self.tolerance);
        self.grade = self.grade.max(grade);
        let allowed = [self.allowed_by_digits, allowed_by_digits].into_iter().flatten();
        self.allowed_by_digits = allowed.reduce(PoseError::larger);
        if self.poses_disagree() {
            self.verdict = Agreement::Disagree;
        }
    }

    /// Whether two files agree because of the digits that they are typed with, beyond the default tolerance.
    pub fn is_judged_by_digits(&self) -> bool {
        let mut written = self.comparisons.iter().filter(|of| of.name.is_written());
        written.any(|of| of.verdict == Agreement::Agree && !of.worst.error.is_within(&self.tolerance))
    }

    /// What the digits allow, if they decide.
    pub fn allowed_if_by_digits(&self) -> Option<PoseError> {
        self.allowed_by_digits.filter(|_| self.is_judged_by_digits())
    }

    /// Whether poses differ, and not dynamics alone.
    pub fn poses_disagree(&self) -> bool {
        self.comparisons.iter().any(|comparison| comparison.verdict == Agreement::Disagree)
    }
}

/// Refuses positions so large that numbers of their size are further apart than the tolerance.
fn resolved(description: &RobotDescription, configurations: &RobotQList) -> Result<(), CheckError> {
    let (robot, tolerance) = (&description.robot, &description.tolerance);
    for (number, q) in (1..).zip(configurations.iter()) {
        for (&joint, &position) in robot.movable_joints().iter().zip(q.iter()) {
            let joint = robot.joint(joint);
            // Beyond this spacing the sine of the position is rounding noise, and sources would disagree about
            // nothing.
            let spacing = position.abs().next_up() - position.abs();
            let most = if joint.kind.is_angular() { tolerance.orientation_rad } else { tolerance.position_m };
            if spacing > most {
                let unit = joint.kind.unit();
                let (joint, what) =
                    (joint.name.clone(), [position, spacing, most].map(|it| quantity(it, unit)));
                return Err(CheckError::Unresolved { number, joint, what });
            }
        }
    }
    Ok(())
}

/// The physics and what is known of its chain, or why it was not compared.
struct Physics<'a> {
    source: Option<&'a mut dyn LinkPoses>,
    identified: Option<ScrewChain>,
    certificates: Vec<ReportedCertificate>,
    not_asked: Vec<NotCompared>,
}

impl<'a> Physics<'a> {
    fn new(
        description: &RobotDescription,
        physics: Result<&'a mut dyn LinkPoses, Findings>,
        configurations: &[RobotQ],
    ) -> Result<Self, CheckError> {
        let source = match physics {
            Ok(source) => source,
            Err(findings) => {
                let findings = findings.iter().map(Finding::from).collect();
                let not_asked = vec![NotCompared { source: ComparedSource::Simulation, findings }];
                let certificates = certificates(description, None)?;
                return Ok(Self { source: None, identified: None, certificates, not_asked });
            }
        };
        let identified = IdentifiedChain::new(description, &mut *source, configurations)?;
        let certificates = certificates(description, Some((&identified, &mut *source)))?;
        let identified = Some(identified.chain);
        Ok(Self { source: Some(source), identified, certificates, not_asked: Vec::new() })
    }
}

/// Screws are made from the URDF chain: alone they show that two computations agree, not two descriptions.
pub(super) fn verdict(comparisons: &[Comparison]) -> Agreement {
    if comparisons.iter().any(|comparison| comparison.verdict != Agreement::Agree) {
        Agreement::Disagree
    } else if comparisons.iter().any(|comparison| comparison.name != SourcePair::PoeUrdf) {
        Agreement::Agree
    } else {
        Agreement::NothingCompared
    }
}

/// The largest difference of all comparisons, separately in position and in orientation; link and configuration are
/// those of the position, unless the orientation alone is beyond the tolerance.
pub(super) fn worst_difference(comparisons: &[Comparison], tolerance: &Tolerance) -> WorstDifference {
    let errors = comparisons.iter().map(|comparison| comparison.worst.error);
    let error = errors.fold(PoseError::default(), PoseError::larger);
    // One link and one configuration are reported. If only angles are beyond the tolerance, those of the largest
    // distance would point at a link that is fine.
    let is_turned_only = is_turned_only(&error, tolerance);
    let size = |error: &PoseError| if is_turned_only { error.orientation_rad } else { error.position_m };
    let mut worst = &comparisons.first().expect("screws are always compared with the URDF").worst;
    for Comparison { worst: other, .. } in comparisons {
        if !(size(&worst.error).is_nan() || size(&other.error) <= size(&worst.error)) {
            worst = other;
        }
    }
    WorstDifference { error, ..worst.clone() }
}
