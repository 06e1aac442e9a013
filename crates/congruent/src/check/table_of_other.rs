//! The table of the other description against its own URDF: two descriptions that have the same URDF are not the same robot if
//! one of them has a wrong table.

use congruent_agreement::{
    SourcePair,
    compare::{CheckError, CheckOptions, CheckReport, Comparison, ReportedCertificate},
    report::ReportedDiagnosis,
};
use congruent_description::RobotDescription;
use congruent_input::RevisionName;

use super::own_model::table_against_links;

/// Adds the comparison of the other description's table with its URDF, if it has both. A revision is what the robot was, not what
/// it should be: its table is no part of the answer.
pub(super) fn add_table_of_other(
    geometry: &mut CheckReport,
    [description, other]: [&RobotDescription; 2],
    options: &CheckOptions,
) -> Result<(), CheckError> {
    let is_compared = geometry.comparisons.iter().any(|of| of.name == SourcePair::UrdfOther);
    let is_of_revision = RevisionName::of(&other.path).is_some();
    if other.dh.is_none() || other.own_model().is_some() || is_of_revision || !is_compared {
        return Ok(());
    }
    let mut other = other.clone();
    if description.declared_tolerance.is_declared() {
        (other.tolerance, other.declared_tolerance) = (description.tolerance, description.declared_tolerance);
    }
    let found = table_against_links(&other, options)?;
    let (of_table, pair) = (SourcePair::ModelUrdf, SourcePair::OtherModelUrdf);
    let comparisons = found.comparisons.into_iter().filter(|of| of.name == of_table);
    let comparisons: Vec<Comparison> =
        comparisons.map(|of| Comparison { name: pair, title: pair.title(), ..of }).collect();
    geometry.add_comparisons(comparisons, found.grade, found.allowed_by_digits);
    let certificates = found.certificates.into_iter().filter(|of| of.name == of_table);
    geometry.certificates.extend(certificates.map(|of| ReportedCertificate {
        name: pair,
        title: pair.title(),
        ..of
    }));
    let mut diagnoses = std::mem::take(&mut geometry.diagnoses);
    let of_other = found.diagnoses.into_iter().filter(|of| of.name == of_table);
    diagnoses.extend(of_other.map(|of| ReportedDiagnosis { name: pair, title: pair.title(), ..of }));
    geometry.set_diagnoses(diagnoses);
    Ok(())
}
