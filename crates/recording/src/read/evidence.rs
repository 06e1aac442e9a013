//! What values say about a check: the worst one and the first outside the limit, from any of three origins.

use congruent_twin::verdict::{Bound, Measure};
use serde_json::Value;

/// A value with its time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct At {
    pub(super) time_s: f64,
    pub(super) value: f64,
}

/// A quantity of a check and its limit.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Quantity {
    pub(super) name: String,
    pub(super) unit: String,
    pub(super) bound: Bound,
    pub(super) limit: f64,
}

/// The values of one quantity from one origin.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Evidence {
    pub(super) of: Quantity,
    /// The link, joint or pair with the worst value, if the origin tells.
    pub(super) subject: Option<String>,
    pub(super) worst: At,
    pub(super) first_violation: Option<At>,
}

impl Quantity {
    pub(super) fn of(measure: &Measure) -> Self {
        Self {
            name: measure.quantity.to_owned(),
            unit: measure.unit.to_owned(),
            bound: measure.bound,
            limit: measure.limit,
        }
    }

    pub(super) fn is(&self, name: &str, unit: &str) -> bool {
        self.name == name && self.unit == unit
    }

    fn is_violated_by(&self, at: &At) -> bool {
        !self.bound.holds(at.value, self.limit)
    }
}

impl Evidence {
    /// Of values in order of time; `None` without values.
    pub(super) fn of_values(of: &Quantity, values: &[(f64, f64)]) -> Option<Self> {
        let mut values = values.iter().map(|&(time_s, value)| At { time_s, value });
        let first = values.next()?;
        let mut found = Self {
            of: of.clone(),
            subject: None,
            worst: first,
            first_violation: Some(first).filter(|at| of.is_violated_by(at)),
        };
        for at in values {
            if of.bound.is_worse(at.value, found.worst.value) {
                found.worst = at;
            }
            found.first_violation = found.first_violation.or(Some(at).filter(|at| of.is_violated_by(at)));
        }
        Some(found)
    }

    /// Of the measure of a check that saw the recorded states; `None` without values.
    pub(super) fn of_measure(measure: &Measure) -> Option<Self> {
        let worst = measure.worst.as_ref()?;
        Some(Self {
            of: Quantity::of(measure),
            subject: Some(worst.subject.clone()),
            worst: At { time_s: worst.time_s, value: worst.value },
            first_violation: measure
                .first_violation
                .as_ref()
                .map(|first| At { time_s: first.time_s, value: first.value }),
        })
    }

    /// Of a measure in the report that the recording holds; `None` if there is no value.
    pub(super) fn of_report(measure: &Value) -> Option<Self> {
        let bound = match measure["bound"].as_str()? {
            "at_most" => Bound::AtMost,
            "at_least" => Bound::AtLeast,
            "above" => Bound::Above,
            _ => return None,
        };
        let at = |moment: &Value| {
            // JSON has no infinity and no NaN: such a value is `null`.
            let value = moment["value"].as_f64().unwrap_or(f64::NAN);
            Some(At { time_s: moment["time_s"].as_f64()?, value })
        };
        let of = Quantity {
            name: measure["quantity"].as_str()?.to_owned(),
            unit: measure["unit"].as_str()?.to_owned(),
            bound,
            limit: measure["limit"].as_f64()?,
        };
        let worst = &measure["worst"];
        Some(Self {
            of,
            subject: worst["subject"].as_str().map(str::to_owned),
            worst: at(worst)?,
            first_violation: at(&measure["first_violation"]),
        })
    }

    /// The first value outside a limit, which need not be the one that was known when the values were found.
    pub(super) fn violation_of(&self, limit: f64) -> Option<At> {
        let is_same = limit.to_bits() == self.of.limit.to_bits();
        let worst = Some(self.worst).filter(|at| !self.of.bound.holds(at.value, limit));
        if is_same { self.first_violation.or(worst) } else { worst }
    }

    /// By how much the worst value is beyond a limit; negative if it holds.
    pub(super) fn beyond(&self, limit: f64) -> f64 {
        match self.of.bound {
            Bound::AtMost => self.worst.value - limit,
            Bound::AtLeast | Bound::Above => limit - self.worst.value,
        }
    }

    /// The worse of two of one quantity, with the earlier violation.
    fn merged(self, other: Self) -> Self {
        let first_violation = match (self.first_violation, other.first_violation) {
            (Some(a), Some(b)) if b.time_s < a.time_s => Some(b),
            (a, b) => a.or(b),
        };
        let is_worse = self.of.bound.is_worse(other.worst.value, self.worst.value);
        Self { first_violation, ..if is_worse { other } else { self } }
    }
}

/// One entry for each quantity: a check of distances has one for each pair.
pub(super) fn merged(all: impl Iterator<Item = Evidence>) -> Vec<Evidence> {
    let mut merged: Vec<Evidence> = Vec::new();
    for evidence in all {
        match merged.iter().position(|known| known.of.is(&evidence.of.name, &evidence.of.unit)) {
            Some(at) => merged[at] = merged[at].clone().merged(evidence),
            None => merged.push(evidence),
        }
    }
    merged
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_value_and_the_first_outside_the_limit() {
        let of = Quantity { name: "distance".into(), unit: "m".into(), bound: Bound::AtLeast, limit: 0.1 };
        let found = Evidence::of_values(&of, &[(0.0, 0.2), (1.0, 0.05), (2.0, 0.01)]).unwrap();
        assert_eq!(found.worst, At { time_s: 2.0, value: 0.01 });
        assert_eq!(found.first_violation, Some(At { time_s: 1.0, value: 0.05 }));
        assert!((found.beyond(0.1) - 0.09).abs() < 1e-15);
        assert_eq!(found.violation_of(0.02), Some(At { time_s: 2.0, value: 0.01 }));
        assert_eq!(found.violation_of(0.001), None);
        assert!(Evidence::of_values(&of, &[]).is_none());
    }

    #[test]
    fn a_value_that_is_no_number_violates_every_limit() {
        let of = Quantity { name: "position".into(), unit: "m".into(), bound: Bound::AtMost, limit: 0.1 };
        let found = Evidence::of_values(&of, &[(0.0, 0.0), (1.0, f64::NAN), (2.0, 5.0)]).unwrap();
        assert!(found.worst.value.is_nan());
        assert_eq!(found.first_violation.unwrap().time_s.to_bits(), 1.0_f64.to_bits());
    }
}
