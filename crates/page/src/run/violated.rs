//! The quantities that were violated, in the order of time.

use congruent_monitors::verdict::{CheckResult, Measure, Status};
use congruent_results::report::RunReport;

/// A quantity of a check that was violated.
#[derive(Clone, Copy)]
pub(super) struct Violated<'a> {
    pub(super) number: usize,
    pub(super) check: &'a CheckResult,
    pub(super) measure: &'a Measure,
}

/// What was violated, the first first; of several pairs with one quantity the first one.
pub(super) fn violated(report: &RunReport) -> Vec<Violated<'_>> {
    let mut found: Vec<(f64, Violated<'_>)> = Vec::new();
    for (number, check) in report.checks.iter().enumerate().filter(|(_, of)| of.status == Status::Fail) {
        for measure in &check.measures {
            let Some(first) = &measure.first_violation else { continue };
            found.push((first.time_s, Violated { number, check, measure }));
        }
    }
    // Stable: quantities that are violated at one instant keep the order of the report.
    found.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    let mut kept: Vec<Violated<'_>> = Vec::new();
    for (_, violated) in found {
        let is_same = |known: &Violated<'_>| {
            (known.number, known.measure.quantity) == (violated.number, violated.measure.quantity)
        };
        if !kept.iter().any(is_same) {
            kept.push(violated);
        }
    }
    kept
}
