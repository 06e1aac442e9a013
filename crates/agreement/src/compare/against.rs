//! A robot's URDF against another description of the same joints: the checks of [`check`](super::check::check), added
//! to its report under the name of that pair, with a cause of their difference that two URDFs can have.

use congruent_description::RobotDescription;
use congruent_input::RevisionName;
use congruent_kinematics::{LinkPoses, PoseError};
use congruent_mapping::{ComparedAt, MatchedRobots, explained_by_joints};

use super::{
    certificate::{Brackets, worst},
    check::{CheckOptions, ComparedSources, compared, verdict, worst_difference},
    check_report::{Agreement, CheckReport, Comparison},
    differences_at::without_table,
    error::CheckError,
    grade::Grade,
};
use crate::{
    diagnosis::Cause,
    report::{ReportedDiagnosis, diagnose_models, diagnosed_by_joints, may_be_unit, screw_differences},
    source_pair::SourcePair,
};

impl CheckReport {
    /// Adds the comparison with another description: its difference, certificate and diagnosis. `poses` are those of
    /// the other description, at the links and the configurations of this one; both have the same moving joints by
    /// name.
    ///
    /// # Errors
    /// [`CheckError`] if the source rejects a configuration.
    pub fn add_other(
        &mut self,
        description: &RobotDescription,
        other: &RobotDescription,
        poses: &mut dyn LinkPoses,
        options: &CheckOptions,
    ) -> Result<(), CheckError> {
        let urdf = without_table(description);
        let mut compared = compared(&urdf, Ok(&mut *poses), options)?;
        let robots = MatchedRobots::new([&description.robot, &other.robot], poses)?;
        let by_digits = explained_by_digits(&compared.report, other, &robots);
        if by_digits.is_none() {
            let mut diagnoses = std::mem::take(&mut self.diagnoses);
            diagnoses.extend(diagnosed([&urdf, other], &compared, &robots, poses)?);
            self.set_diagnoses(diagnoses);
        }
        let found = &mut compared.report;
        let pair = SourcePair::UrdfOther;
        let is_other = |name: SourcePair| name == SourcePair::UrdfSimulation;
        for mut comparison in found.comparisons.drain(..).filter(|of| is_other(of.name)) {
            (comparison.name, comparison.title) = (pair, pair.title());
            let grade = match by_digits {
                Some(_) => Grade::SameWithinDigits,
                None => Grade::from_difference(&comparison.worst.error),
            };
            let PoseError { position_m, orientation_rad } = comparison.worst.error;
            let is_allowed = description.declared_tolerance.allows(position_m, orientation_rad);
            if grade == Grade::SameWithinDigits && is_allowed {
                comparison.verdict = Agreement::Agree;
            }
            self.grade = self.grade.max(Some(grade));
            self.comparisons.push(comparison);
        }
        for mut certificate in found.certificates.drain(..).filter(|of| is_other(of.name)) {
            (certificate.name, certificate.title) = (pair, pair.title());
            self.certificates.push(certificate);
        }
        self.verdict = verdict(&self.comparisons);
        let allowed = [self.allowed_by_digits, by_digits];
        self.allowed_by_digits = allowed.into_iter().flatten().reduce(PoseError::larger);
        self.worst = worst_difference(&self.comparisons, &self.tolerance);
        let brackets = worst(&self.certificates);
        self.certificate = brackets.as_ref().map(Brackets::bounds);
        self.certificate_bracket = brackets;
        Ok(())
    }
}

impl CheckReport {
    /// Adds to the bounds of the other description how far it may be from what it stands for, such as poses of a program that computes
    /// with fewer digits: by the triangle inequality the two add up.
    pub fn add_residual_of_other(&mut self, PoseError { position_m, orientation_rad }: PoseError) {
        let of_other = self.certificates.iter_mut().filter(|of| of.name == SourcePair::UrdfOther);
        for brackets in of_other.filter_map(|of| of.brackets.as_mut()) {
            brackets.position_m.certified += position_m;
            brackets.orientation_rad.certified += orientation_rad;
        }
        let brackets = worst(&self.certificates);
        self.certificate = brackets.as_ref().map(Brackets::bounds);
        self.certificate_bracket = brackets;
    }
}

/// What second-order terms add to differences that digits allow. No unit, relative; kind: choice.
const MARGIN: f64 = 1.01;
/// Rounding of computed angles, rad.
const ANGLE_RAD: f64 = 1e-9;

/// Whether the digits of two files count: not those of a revision, since what changes is asked for.
fn digits_count(other: &RobotDescription) -> bool {
    RevisionName::of(&other.path).is_none()
}

/// What the digits of the two files allow, if they explain a difference: also that of links which are compared and have no digits
/// that place them.
fn explained_by_digits(
    report: &CheckReport,
    other: &RobotDescription,
    robots: &MatchedRobots<'_>,
) -> Option<PoseError> {
    let is_pair = |of: &&Comparison| of.name == SourcePair::UrdfSimulation;
    let differ = report
        .comparisons
        .iter()
        .filter(is_pair)
        .any(|of| Grade::from_difference(&of.worst.error) == Grade::Different);
    let allowed = (differ && digits_count(other)).then(|| robots.explained_by_digits()).flatten()?;
    // To first order turns add up to the same in all configurations, and shifts to what turns add across the reach.
    let most_m = allowed.position_m + 2.0 * robots.reach_m() * allowed.orientation_rad;
    let is_allowed = |of: &Comparison| {
        let PoseError { position_m, orientation_rad } = of.worst.error;
        position_m <= MARGIN * most_m && orientation_rad <= MARGIN * allowed.orientation_rad + ANGLE_RAD
    };
    report.comparisons.iter().filter(is_pair).all(is_allowed).then_some(allowed)
}

/// Why two descriptions differ: joints with another origin or axis, or else the diagnosis of the chain from base to
/// tip.
fn diagnosed(
    descriptions: [&RobotDescription; 2],
    ComparedSources { report, identified, diagnosed: configurations }: &ComparedSources,
    robots: &MatchedRobots<'_>,
    poses: &mut dyn LinkPoses,
) -> Result<Option<ReportedDiagnosis>, CheckError> {
    let description = descriptions[0];
    let by_chain = || {
        let diagnoses = diagnose_models(description, identified.as_ref(), configurations);
        let of_pair = diagnoses.into_iter().find(|of| of.name == SourcePair::UrdfSimulation);
        let pair = SourcePair::UrdfOther;
        of_pair.map(|diagnosis| ReportedDiagnosis { name: pair, title: pair.title(), ..diagnosis })
    };
    // The chains agree: matching joints would only name frames of links that lie elsewhere.
    if report.verdict == Agreement::Agree {
        return Ok(by_chain());
    }
    let (base, tip) = (description.base, description.tip);
    let at = ComparedAt {
        configurations,
        tolerance: &description.tolerance,
        digits_count: digits_count(descriptions[1]),
        base,
        tip,
    };
    let Some(explained) = explained_by_joints(robots, poses, &at)? else {
        return Ok(by_chain());
    };
    // Several origins that are all off by a factor of 1000 are one fault, a wrong unit, which the diagnosis of the
    // chain names as one.
    if may_be_unit(&explained, robots) {
        let by_unit = by_chain();
        let is_unit = |of: &ReportedDiagnosis| {
            of.causes.first().is_some_and(|first| first.fault.cause == Cause::MillimetresAsMetres)
        };
        if by_unit.as_ref().is_some_and(is_unit) {
            return Ok(by_unit);
        }
    }
    let differences = identified.as_ref().map(|chain| screw_differences(description, chain));
    Ok(Some(diagnosed_by_joints(descriptions, robots, &explained, differences.unwrap_or_default())))
}
