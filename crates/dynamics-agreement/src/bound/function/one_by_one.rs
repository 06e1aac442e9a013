//! A bound of a function of several values by the bound of each value alone.

use super::{
    branch::{SearchLimits, UpperBound, upper_bound},
    local_search,
    measure::ValueMeasure,
    trigonometric::Trigonometric,
};
use crate::thresholds::{CLOSED_SUM, MAX_BOXES, MAX_MOTION_VALUES};

/// Control values of one acceleration or product of speeds. Kind: speed; some 5 ms.
const VALUES_OF_ONE: usize = MAX_MOTION_VALUES / 12;
/// If fewer boxes can be divided, the sum of amplitudes is the better bound. Kind: choice.
pub(in crate::bound) const FEWEST_BOXES: usize = 10;

/// A bound by the sum of the largest values of each acceleration and of each product of two speeds: these maxima are at
/// different positions, so the bound is wider, but each value depends on fewer joints.
pub(in crate::bound) fn one_by_one(function: &Trigonometric) -> UpperBound {
    let mut sum = UpperBound { value: 0.0, boxes: 0 };
    for at in 0..function.values {
        let one = function.selected(at..at + 1, ValueMeasure::Sum);
        let mut bound = UpperBound { value: one.sum_of_amplitudes(), boxes: 0 };
        if one.control_values() <= VALUES_OF_ONE / FEWEST_BOXES {
            let control_values = VALUES_OF_ONE;
            let stop = SearchLimits {
                below: local_search::largest_of_three(&one) * (1.0 + CLOSED_SUM),
                boxes: MAX_BOXES,
                control_values,
            };
            let divided = upper_bound(&one, stop);
            bound = UpperBound { value: divided.value.min(bound.value), boxes: divided.boxes };
        }
        sum.value += bound.value;
        sum.boxes += bound.boxes;
    }
    sum
}
