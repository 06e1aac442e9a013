//! The pairs of one moving link with bodies at rest, ordered by when they may be near. A pair waits until the link has
//! moved far enough: pairs far away cost nothing meanwhile, however many there are.

use std::{cmp::Ordering, collections::BinaryHeap};

/// A pair in the queue of a link.
#[derive(Debug, Clone, Copy)]
struct Waiting {
    /// Total path length of the link, m, before which the pair cannot touch.
    reach_m: f64,
    pair: usize,
}

impl Ord for Waiting {
    /// A heap gives its greatest first: that is the pair with the smallest reach.
    fn cmp(&self, other: &Self) -> Ordering {
        // `total_cmp`: pairs that were not measured are at minus infinity, which comes first. Equal reaches go by
        // index, so that runs repeat.
        other.reach_m.total_cmp(&self.reach_m).then(other.pair.cmp(&self.pair))
    }
}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Waiting {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Waiting {}

/// The waiting pairs of one link.
#[derive(Debug, Clone, Default)]
pub(super) struct WaitingPairs(BinaryHeap<Waiting>);

impl WaitingPairs {
    /// Queues a pair that cannot touch before the link has moved by `reach_m` in total.
    pub(super) fn push(&mut self, reach_m: f64, pair: usize) {
        self.0.push(Waiting { reach_m, pair });
    }

    /// Removes the next pair that can be nearer than `threshold_m` after the link has moved by `travel_m` in total.
    pub(super) fn pop_below(&mut self, threshold_m: f64, travel_m: f64) -> Option<usize> {
        let next = self.0.peek()?;
        if next.reach_m - travel_m < threshold_m { self.0.pop().map(|next| next.pair) } else { None }
    }
}
