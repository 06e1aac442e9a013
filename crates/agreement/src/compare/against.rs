//! A robot's URDF against another description of the same joints: the checks of [`check`](super::check::check), added
//! to its report under the name of that pair, with a cause of their difference that two URDFs can have.

use congruent_description::RobotDescription;
use congruent_kinematics::LinkPoses;
use congruent_mapping::MatchedRobots;

use super::{
    certificate::{Brackets, worst},
    check::{CheckOptions, ComparedSources, compared, verdict, worst_difference},
    check_report::{Agreement, CheckReport},
    differences_at::without_table,
    error::CheckError,
    grade::Grade,
};
use crate::{
    diagnosis::{
        Cause,
        joints::{ComparedAt, explained_by_joints},
    },
    report::{ReportedDiagnosis, diagnose_models, diagnosed_by_joints, screw_differences},
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
        let compared = compared(&urdf, Ok(&mut *poses), options)?;
        let mut diagnoses = std::mem::take(&mut self.diagnoses);
        diagnoses.extend(diagnosed([&urdf, other], &compared, poses)?);
        self.set_diagnoses(diagnoses);
        let found = compared.report;
        let pair = SourcePair::UrdfOther;
        let is_other = |name: SourcePair| name == SourcePair::UrdfSimulation;
        for mut comparison in found.comparisons.into_iter().filter(|of| is_other(of.name)) {
            (comparison.name, comparison.title) = (pair, pair.title());
            self.comparisons.push(comparison);
        }
        for mut certificate in found.certificates.into_iter().filter(|of| is_other(of.name)) {
            (certificate.name, certificate.title) = (pair, pair.title());
            self.certificates.push(certificate);
        }
        self.verdict = verdict(&self.comparisons);
        let compared = self.comparisons.iter().filter(|of| of.name == pair);
        self.grade = self.grade.max(compared.map(|of| Grade::from_difference(&of.worst.error)).max());
        self.worst = worst_difference(&self.comparisons, &self.tolerance);
        let brackets = worst(&self.certificates);
        self.certificate = brackets.as_ref().map(Brackets::bounds);
        self.certificate_bracket = brackets;
        Ok(())
    }
}

/// Why two descriptions differ: joints with another origin or axis, or else the diagnosis of the chain from base to
/// tip.
fn diagnosed(
    descriptions: [&RobotDescription; 2],
    ComparedSources { report, identified, diagnosed: configurations }: &ComparedSources,
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
    let robots = MatchedRobots::new(descriptions.map(|of| &of.robot), poses)?;
    let (base, tip) = (description.base, description.tip);
    let at = ComparedAt { configurations, tolerance: &description.tolerance, base, tip };
    let Some(explained) = explained_by_joints(&robots, poses, &at)? else {
        return Ok(by_chain());
    };
    // Several origins that are all off by a factor of 1000 are one fault, a wrong unit, which the diagnosis of the
    // chain names as one.
    if explained.may_be_unit(&robots) {
        let by_unit = by_chain();
        let is_unit = |of: &ReportedDiagnosis| {
            of.causes.first().is_some_and(|first| first.fault.cause == Cause::MillimetresAsMetres)
        };
        if by_unit.as_ref().is_some_and(is_unit) {
            return Ok(by_unit);
        }
    }
    let differences = identified.as_ref().map(|chain| screw_differences(description, chain));
    Ok(Some(diagnosed_by_joints(descriptions, &robots, &explained, differences.unwrap_or_default())))
}
