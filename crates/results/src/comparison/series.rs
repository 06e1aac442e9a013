//! One series of two runs, value after value.

use serde_json::Value as Json;

use super::{
    difference::{SeriesDifference, ValueDifference},
    report_label::{ReportLabel, UNITS},
};
use crate::trajectory_file::Value;

/// Differences of one series so far.
pub(super) struct SeriesComparison {
    name: String,
    joint: Option<String>,
    label: Option<String>,
    unit: &'static str,
    tolerance: f64,
    counts: Counts,
    first: Option<ValueDifference>,
    worst: Option<ValueDifference>,
    /// How far the worst values are apart; infinite if one of them is not a number.
    worst_apart: f64,
}

#[derive(Default)]
struct Counts {
    compared: u64,
    differing: u64,
    only_in: [u64; 2],
}

/// Two units of time are one if they are no further apart than that: a sum of steps is rounded. Unit: s.
pub(super) const SAME_TIME_S: f64 = 1e-9;

impl SeriesComparison {
    pub(super) fn new(name: &str, joint: Option<String>, tolerance: f64) -> Self {
        Self {
            name: name.to_owned(),
            joint,
            label: None,
            unit: unit(name),
            tolerance,
            counts: Counts::default(),
            first: None,
            worst: None,
            worst_apart: 0.0,
        }
    }

    /// The same with what it is in words, and its unit if that is known.
    pub(super) fn labelled(self, label: Option<ReportLabel>) -> Self {
        let Some(ReportLabel { words, unit }) = label else { return self };
        Self { label: Some(words), unit: unit.unwrap_or(self.unit), ..self }
    }

    /// Takes the values of both at one time.
    pub(super) fn observe(&mut self, time_s: Option<f64>, a: &Value, b: &Value) {
        self.counts.compared += 1;
        let Some(apart) = apart(a, b, self.tolerance) else { return };
        self.counts.differing += 1;
        let is_worst = self.worst.is_none() || apart > self.worst_apart;
        if !is_worst && self.first.is_some() {
            return;
        }
        let difference = ValueDifference {
            series: self.name.clone(),
            label: self.label.clone(),
            joint: self.joint.clone(),
            time_s,
            a: json(a),
            b: json(b),
            difference: match (a, b) {
                (Value::Number(a), Value::Number(b)) => Some(b - a).filter(|apart| apart.is_finite()),
                _ => None,
            },
        };
        if is_worst {
            (self.worst, self.worst_apart) = (Some(difference.clone()), apart);
        }
        self.first.get_or_insert(difference);
    }

    /// Counts a time at which only A (0) or only B (1) has a value.
    pub(super) fn only_in(&mut self, side: usize) {
        self.counts.only_in[side] += 1;
    }

    /// The differences; `None` without any.
    pub(super) fn finish(self) -> Option<SeriesDifference> {
        let Counts { compared, differing, only_in: [only_in_a, only_in_b] } = self.counts;
        let (first, worst) = (self.first, self.worst);
        let differs = differing + only_in_a + only_in_b > 0;
        let unit = self.unit;
        differs.then_some(SeriesDifference {
            series: self.name,
            unit,
            compared,
            differing,
            only_in_a,
            only_in_b,
            first,
            worst,
        })
    }
}

/// Whether a series is compared: with a tolerance, which of two links has the largest error is left to rounding, and so is the
/// instant of that error with its configuration.
pub(super) fn is_compared(name: &str, tolerance: f64) -> bool {
    let is_of_moment = || {
        let moment = [".worst.", ".first_violation.", ".nearest_that_changes."];
        moment.iter().any(|moment| name.contains(moment)) && name.rsplit('.').next() != Some("value")
    };
    tolerance <= 0.0
        || !["_link", "_pair", ".subject"].iter().any(|end| name.ends_with(end)) && !is_of_moment()
}

/// How far two values are apart if that is beyond the tolerance. NaN is equal to NaN alone.
fn apart(a: &Value, b: &Value, tolerance: f64) -> Option<f64> {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => {
            #[expect(clippy::float_cmp, reason = "equal infinities are no distance apart")]
            let is_same = a == b || (a.is_nan() && b.is_nan()) || (a - b).abs() <= tolerance;
            let apart = (a - b).abs();
            (!is_same).then_some(if apart.is_nan() { f64::INFINITY } else { apart })
        }
        (Value::Name(a), Value::Name(b)) => (a != b).then_some(f64::INFINITY),
        (Value::Missing, Value::Missing) => None,
        _ => Some(f64::INFINITY),
    }
}

fn json(value: &Value) -> Json {
    match value {
        Value::Number(number) if number.is_finite() => (*number).into(),
        Value::Number(number) => number.to_string().into(),
        Value::Name(name) => name.as_str().into(),
        Value::Missing => Json::Null,
    }
}

/// The unit at the end of a name, as reports write it.
fn unit(name: &str) -> &'static str {
    UNITS.into_iter().find(|(end, _)| name.ends_with(end)).map_or("", |(_, unit)| unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(tolerance: f64, values: &[(f64, f64)]) -> Option<SeriesDifference> {
        let mut series = SeriesComparison::new("elbow.q_rad", None, tolerance);
        for (&(a, b), time_s) in values.iter().zip([0.0, 0.25, 0.5, 0.75]) {
            series.observe(Some(time_s), &Value::Number(a), &Value::Number(b));
        }
        series.finish()
    }

    #[test]
    fn the_first_and_the_worst_are_found() {
        let found = series(0.0, &[(1.0, 1.0), (1.0, 1.0 + 1e-12), (1.0, 0.5), (2.0, 2.1)]).unwrap();
        assert_eq!((found.compared, found.differing, found.unit), (4, 3, "rad"));
        assert_eq!(found.first.unwrap().time_s, Some(0.25));
        let worst = found.worst.unwrap();
        assert_eq!((worst.time_s, worst.difference), (Some(0.5), Some(-0.5)));
    }

    #[test]
    fn a_tolerance_is_the_largest_difference_that_counts_as_none() {
        assert!(series(0.5, &[(1.0, 1.5), (1.5, 1.0)]).is_none());
        assert_eq!(series(0.5, &[(1.0, 1.5), (1.0, 1.75)]).unwrap().first.unwrap().time_s, Some(0.25));
    }

    #[test]
    fn nan_is_nan_alone() {
        let (nan, inf) = (f64::NAN, f64::INFINITY);
        assert!(series(0.0, &[(nan, nan), (inf, inf), (-0.0, 0.0)]).is_none());
        let found = series(1e9, &[(5.0, 1e10), (nan, 1.0), (inf, -inf)]).unwrap();
        assert_eq!(found.differing, 3);
        let worst = found.worst.unwrap();
        assert_eq!((worst.a, worst.b, worst.difference), ("NaN".into(), 1.0.into(), None));
    }

    #[test]
    fn subjects_of_worst_values_are_left_out_with_a_tolerance() {
        assert!(is_compared("clearance_pair", 0.0) && !is_compared("clearance_pair", 1e-9));
        assert!(is_compared("checks.1.status", 1e-9) && is_compared("checks.1.measures.1.worst.value", 1e-9));
        let moments = ["checks.1.measures.1.worst.q.elbow", "checks.1.measures.1.first_violation.time_s"];
        assert!(moments.iter().all(|name| is_compared(name, 0.0) && !is_compared(name, 1e-9)));
        let mut series = SeriesComparison::new("checks.1.status", None, 1.0);
        series.observe(None, &Value::Name("pass".into()), &Value::Name("fail".into()));
        assert!(series.finish().is_some());
    }
}
