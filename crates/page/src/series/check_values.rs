//! What the checks measured over time, each quantity in bounded memory: the curve of what failed comes from here.

use congruent_input::{Quantity, SiUnit};
use congruent_monitors::verdict::CheckValue;

use super::{
    buckets::Buckets,
    plots::{Floats, PlotLine},
};

/// Most buckets of a quantity, as of other series.
const MOST_BUCKETS: usize = 750;

/// One quantity of one check.
#[derive(Debug)]
struct QuantityValues {
    check: usize,
    quantity: Quantity,
    unit: SiUnit,
    values: Buckets,
}

/// All quantities of all checks that have values over time.
#[derive(Debug, Default)]
pub(crate) struct CheckValues {
    quantities: Vec<QuantityValues>,
}

impl CheckValues {
    /// Takes the values of one instant. A quantity gets its memory when it first has a value.
    pub(crate) fn push(&mut self, time_s: f64, values: &[CheckValue]) {
        for value in values {
            let (check, quantity, unit) = (value.check, value.of.quantity, value.of.unit);
            let known = self
                .quantities
                .iter()
                .position(|of| (of.check, of.quantity, of.unit) == (check, quantity, unit));
            let at = known.unwrap_or_else(|| {
                let values = Buckets::new(1, MOST_BUCKETS);
                self.quantities.push(QuantityValues { check, quantity, unit, values });
                self.quantities.len() - 1
            });
            self.quantities[at].values.push(time_s, std::iter::once(value.of.value));
        }
    }

    /// Closes the open buckets: no sample follows.
    pub(crate) fn finish(&mut self) {
        self.quantities.iter_mut().for_each(|of| of.values.finish());
    }

    /// The curve of a quantity of the check with this number, from 0; `None` if it is known only at the end.
    pub(crate) fn line(&self, check: usize, quantity: Quantity, name: &str) -> Option<PlotLine> {
        let of = self.quantities.iter().find(|of| (of.check, of.quantity) == (check, quantity))?;
        of.values.range(0)?;
        Some(PlotLine {
            name: name.to_owned(),
            values: Floats(of.values.values(0)),
            times_s: Some(Floats(of.values.times_s())),
            ..PlotLine::default()
        })
    }
}

#[cfg(test)]
mod tests {
    use congruent_monitors::verdict::{Bound, InstantValue};
    use congruent_scenario::CheckKind;

    use super::*;

    #[test]
    fn quantities_that_are_known_now_and_then_have_curves_of_their_own() {
        let value = |check: usize, quantity: Quantity, value: f64| CheckValue {
            check,
            kind: CheckKind::Dynamics,
            of: InstantValue {
                quantity,
                unit: SiUnit::Ratio,
                bound: Bound::AtMost,
                limit: 1.0,
                value,
                subject: 0,
            },
        };
        let mut values = CheckValues::default();
        values.push(0.0, &[value(0, Quantity::EnergyError, 0.5)]);
        values.push(1.0, &[value(0, Quantity::EnergyError, 0.7), value(1, Quantity::EnergyError, 3.0)]);
        values.finish();
        let [first, second] =
            [0, 1].map(|check| values.line(check, Quantity::EnergyError, "energy error").unwrap());
        assert_eq!((first.values.0, first.times_s.unwrap().0), (vec![0.5, 0.7], vec![0.0, 1.0]));
        assert_eq!((second.values.0, second.times_s.unwrap().0), (vec![3.0], vec![1.0]));
        assert!(values.line(0, Quantity::CycleTime, "cycle time").is_none());
    }
}
