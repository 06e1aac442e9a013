//! The grade of a robot's sources: table and URDF by the digits that they are typed with, the others by rounding.

use congruent_description::{RobotDescription, RobotQ};
use congruent_kinematics::PoseError;

use super::{
    check_report::{Agreement, Comparison},
    grade::Grade,
};
use crate::{report::digits_of_table, source_pair::SourcePair};

/// A grade, and what the digits allow if the sources are not identical.
pub(super) struct Graded {
    pub(super) grade: Grade,
    pub(super) allowed_by_digits: Option<PoseError>,
}

impl Graded {
    /// Grades the comparisons of a robot; `configurations` are those at which causes are judged.
    ///
    /// A table that is the same within its digits agrees, if it is within what is declared of a tolerance.
    pub(super) fn new(
        description: &RobotDescription,
        comparisons: &mut [Comparison],
        configurations: impl FnOnce() -> Vec<RobotQ>,
    ) -> Self {
        let computed = comparisons.iter().filter(|comparison| comparison.name != SourcePair::ModelUrdf);
        let computed =
            computed.map(|of| Grade::from_difference(&of.worst.error)).max().unwrap_or(Grade::Identical);
        let table = comparisons.iter_mut().find(|comparison| comparison.name == SourcePair::ModelUrdf);
        let Some(table) =
            table.filter(|table| Grade::from_difference(&table.worst.error) == Grade::Different)
        else {
            return Self { grade: computed, allowed_by_digits: None };
        };
        let Some(digits) = digits_of_table(description, &configurations()) else {
            return Self { grade: Grade::Different, allowed_by_digits: None };
        };
        let grade = if digits.explain_all { Grade::SameWithinDigits } else { Grade::Different };
        let PoseError { position_m, orientation_rad } = table.worst.error;
        if digits.explain_all && description.declared_tolerance.allows(position_m, orientation_rad) {
            table.verdict = Agreement::Agree;
        }
        Self { grade: grade.max(computed), allowed_by_digits: Some(digits.allowed) }
    }
}
