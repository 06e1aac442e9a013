//! Which values of a report the recording shows: the measures of one kind of check, and the first violations.

use congruent_monitors::verdict::{CheckResult, Measure, Moment};
use congruent_results::report::RunReport;
use congruent_scenario::CheckKind;

/// All measures of all checks of one kind.
pub(crate) fn measures_of_kind(report: &RunReport, kind: CheckKind) -> impl Iterator<Item = &Measure> {
    report.checks.iter().filter(move |check| check.check == kind).flat_map(|check| &check.measures)
}

/// The first violation of a check.
pub(crate) fn first_violation(check: &CheckResult) -> Option<(&Measure, &Moment)> {
    check
        .measures
        .iter()
        .filter_map(|measure| Some((measure, measure.first_violation.as_ref()?)))
        .min_by(|(_, a), (_, b)| a.time_s.total_cmp(&b.time_s))
}

/// Time of the first violation of any check.
pub(crate) fn first_violation_s(report: &RunReport) -> Option<f64> {
    report.checks.iter().filter_map(first_violation).map(|(_, moment)| moment.time_s).min_by(f64::total_cmp)
}
