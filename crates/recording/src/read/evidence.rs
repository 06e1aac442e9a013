//! Evidence on a quantity of a check: the worst value and the first one outside the limit, from any of three origins.

use congruent_input::{Quantity, SiUnit};
use congruent_monitors::verdict::{Bound, Measure};

/// A value with its time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TimedValue {
    pub(super) time_s: f64,
    pub(super) value: f64,
}

/// A quantity of a check and its limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LimitedQuantity {
    pub(super) name: Quantity,
    pub(super) unit: SiUnit,
    pub(super) bound: Bound,
    pub(super) limit: f64,
}

/// The values of one quantity from one origin.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Evidence {
    pub(super) of: LimitedQuantity,
    /// The link, joint or pair with the worst value, if the origin records it.
    pub(super) subject: Option<String>,
    pub(super) worst: TimedValue,
    pub(super) first_violation: Option<TimedValue>,
}

impl LimitedQuantity {
    pub(super) fn from_measure(measure: &Measure) -> Self {
        Self { name: measure.quantity, unit: measure.unit, bound: measure.bound, limit: measure.limit }
    }

    pub(super) fn is(&self, name: Quantity, unit: SiUnit) -> bool {
        self.name == name && self.unit == unit
    }

    fn is_violated_by(&self, at: &TimedValue) -> bool {
        !self.bound.holds(at.value, self.limit)
    }
}

impl Evidence {
    /// Evidence of a series of values in order of time; `None` without values.
    pub(super) fn from_values(of: LimitedQuantity, values: &[(f64, f64)]) -> Option<Self> {
        let mut values = values.iter().map(|&(time_s, value)| TimedValue { time_s, value });
        let first = values.next()?;
        let mut found = Self {
            of,
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

    /// Evidence of a measure, of the report or of a check that was evaluated on the recorded states; `None` without values.
    pub(super) fn from_measure(measure: &Measure) -> Option<Self> {
        let worst = measure.worst.as_ref()?;
        Some(Self {
            of: LimitedQuantity::from_measure(measure),
            subject: Some(worst.subject.clone()),
            worst: TimedValue { time_s: worst.time_s, value: worst.value },
            first_violation: measure
                .first_violation
                .as_ref()
                .map(|first| TimedValue { time_s: first.time_s, value: first.value }),
        })
    }

    /// The first value outside a limit, which need not be the one that was known when the values were found.
    pub(super) fn violation_of(&self, limit: f64) -> Option<TimedValue> {
        // The first violation is known for the limit that the values were judged by; for another one, only whether
        // the worst value violates it.
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
        // The earlier violation and the worse value may be of different pairs of bodies.
        let is_worse = self.of.bound.is_worse(other.worst.value, self.worst.value);
        Self { first_violation, ..if is_worse { other } else { self } }
    }
}

/// One entry for each quantity: a check of distances has one for each pair.
pub(super) fn merged(all: impl Iterator<Item = Evidence>) -> Vec<Evidence> {
    let mut merged: Vec<Evidence> = Vec::new();
    for evidence in all {
        match merged.iter().position(|known| known.of.is(evidence.of.name, evidence.of.unit)) {
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
        let of = LimitedQuantity {
            name: Quantity::Distance,
            unit: SiUnit::Metre,
            bound: Bound::AtLeast,
            limit: 0.1,
        };
        let found = Evidence::from_values(of, &[(0.0, 0.2), (1.0, 0.05), (2.0, 0.01)]).unwrap();
        assert_eq!(found.worst, TimedValue { time_s: 2.0, value: 0.01 });
        assert_eq!(found.first_violation, Some(TimedValue { time_s: 1.0, value: 0.05 }));
        assert!((found.beyond(0.1) - 0.09).abs() < 1e-15);
        assert_eq!(found.violation_of(0.02), Some(TimedValue { time_s: 2.0, value: 0.01 }));
        assert_eq!(found.violation_of(0.001), None);
        assert!(Evidence::from_values(of, &[]).is_none());
    }

    #[test]
    fn a_value_that_is_not_a_number_violates_every_limit() {
        let of = LimitedQuantity {
            name: Quantity::Position,
            unit: SiUnit::Metre,
            bound: Bound::AtMost,
            limit: 0.1,
        };
        let found = Evidence::from_values(of, &[(0.0, 0.0), (1.0, f64::NAN), (2.0, 5.0)]).unwrap();
        assert!(found.worst.value.is_nan());
        assert_eq!(found.first_violation.unwrap().time_s.to_bits(), 1.0_f64.to_bits());
    }
}
