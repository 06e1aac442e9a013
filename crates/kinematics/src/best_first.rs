//! The loop of branch and bound, best first: an upper bound of a maximum over a box, by halving the box whose bound is largest.
//! How a box is bounded, and when a bound is good enough, is decided by the caller.

use std::{cmp::Reverse, collections::BTreeMap};

/// The upper bound of the box `whole` when `divide` gives no parts of the box with the largest bound. Parts cover the box that
/// they are of, and their bounds are not above its bound; no bound is negative.
///
/// # Examples
/// The largest value of `x - x^2` over 0 to 1, bounded on each interval by its two terms one by one:
/// ```
/// use congruent_kinematics::best_first::{halves, least_upper_bound};
/// let upper_bound = |&(lower, upper): &(f64, f64)| upper - lower * lower;
/// let bound = least_upper_bound((0.0, 1.0), upper_bound, |interval| {
///     if upper_bound(interval) > 0.2501 { halves(*interval).map(Vec::from) } else { None }
/// });
/// assert!(bound >= 0.25 && bound <= 0.2501);
/// ```
pub fn least_upper_bound<B>(
    whole: B,
    upper_bound: impl Fn(&B) -> f64,
    mut divide: impl FnMut(&B) -> Option<Vec<B>>,
) -> f64 {
    // Numbers that are not negative have the order of their bits; the sum makes -0 a 0. Of equal bounds the oldest box, so that
    // the order is fixed.
    let key = |node: &B, number: usize| ((upper_bound(node) + 0.0).to_bits(), Reverse(number));
    let mut opened = 0;
    let mut open = BTreeMap::from([(key(&whole, opened), whole)]);
    let mut bound = f64::INFINITY;
    // Best first: the last entry has the largest bound of all open boxes, and together they cover the whole range. So its
    // bound holds for every point, and the loop may end at any time with it. Nothing is gained by another order: every box
    // whose bound is too large has to be divided sooner or later.
    while let Some((_, node)) = open.pop_last() {
        bound = upper_bound(&node);
        let Some(parts) = divide(&node) else { break };
        for part in parts {
            opened += 1;
            open.insert(key(&part, opened), part);
        }
    }
    bound
}

/// Both halves of an interval; `None` if no floating-point number lies between its ends, since it would be halved into itself
/// for ever. The halves share the middle: they are closed intervals, and no point falls between them.
pub fn halves((lower, upper): (f64, f64)) -> Option<[(f64, f64); 2]> {
    let middle = f64::midpoint(lower, upper);
    (lower < middle && middle < upper).then_some([(lower, middle), (middle, upper)])
}
