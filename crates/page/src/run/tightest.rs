//! The quantity that came nearest to its limit.

use congruent_monitors::verdict::{Bound, Measure, Moment, Status};
use congruent_results::report::RunReport;

/// A value with its check, its quantity and the share of the limit that it uses.
pub(crate) struct Tightest<'a> {
    pub(crate) check: &'static str,
    pub(crate) measure: &'a Measure,
    pub(crate) worst: &'a Moment,
    pub(crate) share: f64,
}

impl Tightest<'_> {
    /// The value against its limit: `88 % of the limit`, or of a least value `3.1 times the limit`.
    pub(crate) fn words(&self) -> String {
        match self.measure.bound {
            Bound::AtMost => format!("{:.0} % of the limit", 100.0 * self.share),
            Bound::AtLeast | Bound::Above => format!("{:.1} times the limit", 1.0 / self.share),
        }
    }
}

/// The quantity that uses most of its limit, of the checks that passed; quantities of no size, as rounding, do not count, and of
/// distances those that change.
pub(crate) fn tightest(report: &RunReport) -> Option<Tightest<'_>> {
    let passed = report.checks.iter().filter(|check| check.status == Status::Pass);
    let measures = passed.flat_map(|check| {
        check.measures.iter().filter_map(move |measure| {
            Some((
                check.check.word(),
                measure,
                check.nearest_that_changes.as_ref().or(measure.worst.as_ref())?,
            ))
        })
    });
    let share = |measure: &Measure, worst: f64| {
        let share = match measure.bound {
            Bound::AtMost => worst / measure.limit,
            Bound::AtLeast | Bound::Above => measure.limit / worst,
        };
        (measure.limit > 0.0 && share.is_finite()).then_some(share)
    };
    // Limits of 0, and shares that are not finite, say nothing about how near the run came to failing.
    let shares = measures.filter_map(|(check, measure, worst)| {
        Some(Tightest { check, measure, worst, share: share(measure, worst.value)? })
    });
    shares.max_by(|a, b| a.share.total_cmp(&b.share))
}
