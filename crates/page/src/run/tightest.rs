//! The quantity that came nearest to its limit.

use congruent_monitors::verdict::{Bound, Measure, Status};
use congruent_results::report::RunReport;

/// The quantity that uses most of its limit, of the checks that passed; quantities of no size, as rounding, do not count.
pub(crate) fn tightest(report: &RunReport) -> Option<(&'static str, &Measure, f64)> {
    let passed = report.checks.iter().filter(|check| check.status == Status::Pass);
    let measures =
        passed.flat_map(|check| check.measures.iter().map(|measure| (check.check.word(), measure)));
    let share = |measure: &Measure| {
        let worst = measure.worst.as_ref()?.value;
        let share = match measure.bound {
            Bound::AtMost => worst / measure.limit,
            Bound::AtLeast | Bound::Above => measure.limit / worst,
        };
        (measure.limit > 0.0 && share.is_finite()).then_some(share)
    };
    // Limits of 0, and shares that are not finite, say nothing about how near the run came to failing.
    let shares = measures.filter_map(|(check, measure)| Some((check, measure, share(measure)?)));
    shares.max_by(|a, b| a.2.total_cmp(&b.2))
}
