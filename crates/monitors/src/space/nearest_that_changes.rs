//! The nearest of the pairs whose distance changes in a run: links beside each other keep theirs whatever the robot does, and
//! would hide how near the robot comes to its table.

use congruent_proximity::Nearest;

use crate::{
    sample::Sample,
    verdict::Moment,
    watch::{Watch, WatchedInstant},
};

/// A distance that varies by no more is constant. Kind: rounding and tolerance of the distance query, which was seen to vary by
/// 1e-9 m; joints move links by millimetres. Unit: m.
const CONSTANT_M: f64 = 1e-6;
/// Steps between two looks at the pairs that have not changed so far. Kind: choice; a link moves by some millimetres meanwhile,
/// and from then on its pair is measured whenever it may be the nearest.
const EXAMINED_EVERY: u64 = 10;

pub(super) struct NearestThatChanges {
    nearest: Watch,
    /// For each measured pair its distance at the first sample; negative infinity for one that is not judged.
    first_m: Vec<f64>,
    /// For each measured pair whether its distance has changed.
    has_changed: Vec<bool>,
    /// The nearest changed pair at the present sample.
    found: Option<Nearest>,
    first_s: f64,
    first_q: Vec<f64>,
}

impl NearestThatChanges {
    pub(super) fn new(nearest: Watch) -> Self {
        let (first_m, has_changed, first_q) = (Vec::new(), Vec::new(), Vec::new());
        Self { nearest, first_m, has_changed, found: None, first_s: 0.0, first_q }
    }

    /// Remembers the distances of the first sample, so that no later one allocates.
    pub(super) fn begin(&mut self, pairs: impl Iterator<Item = usize>, sample: &mut Sample<'_>) {
        let count = sample.clearance.pairs().len();
        self.has_changed = vec![false; count];
        self.first_m = vec![f64::NEG_INFINITY; count];
        pairs.for_each(|pair| self.first_m[pair] = sample.clearance.measure(pair));
        (self.first_s, self.first_q) = (sample.time_s, sample.joints.state().q.to_vec());
    }

    /// Looks at a sample in which this pair is the nearest of the run so far.
    pub(super) fn observe(&mut self, nearest: Option<usize>, sample: &mut Sample<'_>) {
        // What came nearest of all changes: nothing else is reported.
        if nearest.is_none_or(|pair| self.has_changed[pair]) {
            return;
        }
        if sample.step.is_multiple_of(EXAMINED_EVERY) || sample.is_last {
            self.examine(sample);
        }
        let Some(worst_m) = self.nearest.worst() else { return };
        self.found = None;
        let (found, has_changed, first_m) = (&mut self.found, &self.has_changed, &self.first_m);
        // A pair that was farther at first has changed as soon as it is nearer.
        let limit_m = |pair: usize| {
            let is_watched = has_changed[pair] || first_m[pair] > worst_m + CONSTANT_M;
            if is_watched { worst_m } else { f64::NEG_INFINITY }
        };
        sample.clearance.below(worst_m, limit_m, |pair, distance_m| {
            if found.is_none_or(|known: Nearest| distance_m < known.distance_m) {
                *found = Some(Nearest { distance_m, pair });
            }
        });
        if let Some(Nearest { distance_m, pair }) = self.found {
            self.has_changed[pair] = true;
            self.nearest.observe(distance_m, pair, sample);
        }
    }

    /// Finds pairs that have changed since the first sample, of those that were nearer than the nearest so far.
    fn examine(&mut self, sample: &mut Sample<'_>) {
        for (pair, &first_m) in self.first_m.iter().enumerate().filter(|(_, first_m)| first_m.is_finite()) {
            let is_nearer = self.nearest.worst().is_none_or(|worst_m| first_m < worst_m);
            if self.has_changed[pair] || !is_nearer {
                continue;
            }
            let distance_m = sample.clearance.measure(pair);
            if (distance_m - first_m).abs() > CONSTANT_M {
                self.has_changed[pair] = true;
                let first = WatchedInstant { time_s: self.first_s, q: &self.first_q };
                self.nearest.observe_at(first_m, pair, first);
                self.nearest.observe(distance_m, pair, sample);
            }
        }
    }

    /// The smallest distance of a pair that changes, if `nearest`, the nearest of all, does not change.
    pub(super) fn moment(
        &self,
        nearest: Option<usize>,
        joints: &[String],
        name: impl Fn(usize) -> String,
    ) -> Option<Moment> {
        let is_constant = nearest.is_some_and(|pair| self.has_changed.get(pair).is_some_and(|has| !has));
        if is_constant { self.nearest.measure(joints, name).worst } else { None }
    }
}
