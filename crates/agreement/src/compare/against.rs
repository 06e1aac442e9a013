//! A robot's URDF against another description of the same joints: the checks of [`check`], added to its report under
//! the name of that pair.

use congruent_description::RobotDescription;
use congruent_kinematics::LinkPoses;

use super::{
    certificate::{Brackets, worst},
    check::{CheckOptions, check, verdict, worst_of},
    check_report::CheckReport,
    differences_at::without_table,
    error::CheckError,
};
use crate::source_pair::SourcePair;

impl CheckReport {
    /// Adds the comparison with another source of the poses of all links: its difference, certificate and diagnosis.
    ///
    /// # Errors
    /// [`CheckError`] if the source rejects a configuration.
    pub fn add_other(
        &mut self,
        description: &RobotDescription,
        other: &mut dyn LinkPoses,
        options: &CheckOptions,
    ) -> Result<(), CheckError> {
        let found = check(&without_table(description), Ok(other), options)?;
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
        for mut diagnosis in found.diagnoses.into_iter().filter(|of| is_other(of.name)) {
            (diagnosis.name, diagnosis.title) = (pair, pair.title());
            self.diagnoses.push(diagnosis);
        }
        if self.diagnosis.is_empty() {
            (self.diagnosis, self.indistinguishable) = (found.diagnosis, found.indistinguishable);
        }
        self.verdict = verdict(&self.comparisons);
        self.worst = worst_of(&self.comparisons, &self.tolerance);
        let brackets = worst(&self.certificates);
        self.certificate = brackets.as_ref().map(Brackets::bounds);
        self.certificate_bracket = brackets;
        Ok(())
    }
}
