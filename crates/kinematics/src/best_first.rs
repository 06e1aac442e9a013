//! The loop of branch and bound, best first: an upper bound of a maximum over a box, by halving the box whose bound is largest.
//! How a box is bounded, and when a bound is good enough, is decided by the caller.

use std::{cmp::Ordering, collections::BinaryHeap};

/// A part of the range of a maximum.
pub trait BoundedBox {
    /// No point of the box has a larger value.
    fn upper_bound(&self) -> f64;
}

/// A box that waits for its division.
struct OpenBox<B> {
    node: B,
    /// How many boxes were opened before it.
    number: usize,
}

/// Largest bound first; of equal bounds the oldest box, so that the order is fixed.
impl<B: BoundedBox> Ord for OpenBox<B> {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_bound = self.node.upper_bound().total_cmp(&other.node.upper_bound());
        by_bound.then(other.number.cmp(&self.number))
    }
}

impl<B: BoundedBox> PartialOrd for OpenBox<B> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<B: BoundedBox> PartialEq for OpenBox<B> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl<B: BoundedBox> Eq for OpenBox<B> {}

/// The upper bound of the box `whole` when `divide` gives no parts of the box with the largest bound. Parts cover the box that
/// they are of, and their bounds are not above its bound.
///
/// # Examples
/// The largest value of `x - x^2` over 0 to 1, bounded on each interval by its two terms one by one:
/// ```
/// use congruent_kinematics::best_first::{BoundedBox, halves, least_upper_bound};
/// struct Part((f64, f64));
/// impl BoundedBox for Part {
///     fn upper_bound(&self) -> f64 {
///         self.0.1 - self.0.0 * self.0.0
///     }
/// }
/// let bound = least_upper_bound(Part((0.0, 1.0)), |part| {
///     (part.upper_bound() > 0.2501).then(|| halves(part.0))?.map(|halves| halves.map(Part).into())
/// });
/// assert!(bound >= 0.25 && bound <= 0.2501);
/// ```
pub fn least_upper_bound<B: BoundedBox>(whole: B, mut divide: impl FnMut(&B) -> Option<Vec<B>>) -> f64 {
    let mut opened = 0;
    let mut open = BinaryHeap::from([OpenBox { node: whole, number: opened }]);
    let mut bound = f64::INFINITY;
    // Best first: the top of the heap has the largest bound of all open boxes, and together they cover the whole range. So its
    // bound holds for every point, and the loop may end at any time with it. Nothing is gained by another order: every box
    // whose bound is too large has to be divided sooner or later.
    while let Some(OpenBox { node, .. }) = open.pop() {
        bound = node.upper_bound();
        let Some(parts) = divide(&node) else { break };
        for node in parts {
            opened += 1;
            open.push(OpenBox { node, number: opened });
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
