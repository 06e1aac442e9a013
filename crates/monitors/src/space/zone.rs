//! Forbidden zones: the convex shapes of the links that a zone names never touch it. Every link that enters a zone is
//! reported, not only the first.

use congruent_description::RobotDescription;
use congruent_input::{Quantity, SiUnit};
use congruent_proximity::Nearest;

use crate::{
    Names,
    monitor::{Monitor, Observed},
    sample::Sample,
    verdict::Bound,
    watch::Watch,
};

/// A link is outside a zone if its distance from it is above this.
const OUTSIDE_M: f64 = 0.0;

pub(crate) struct ZoneMonitor {
    /// The smallest distance of all.
    distance: Watch,
    /// For each link with a zone that is forbidden to it, by the number of the pair; made at the first sample, which
    /// knows them.
    pairs: Vec<Watch>,
    /// The pairs that touch at the present sample.
    found: Vec<Nearest>,
    samples: u64,
}

impl ZoneMonitor {
    pub(crate) fn new(description: &RobotDescription) -> Self {
        let distance = watch(description.robot.dof());
        Self { distance, pairs: Vec::new(), found: Vec::new(), samples: 0 }
    }

    /// Remembers the pairs that touch now for the first time: no distance is below 0, so nothing can be worse.
    fn observe_touching(&mut self, sample: &mut Sample<'_>) {
        let (pairs, found) = (&self.pairs, &mut self.found);
        // `next_up`: touching, a distance of exactly 0, is to be found by a search for what is below. A pair that has
        // touched is known.
        let limit_m =
            |pair: usize| if pairs[pair].is_violated() { f64::NEG_INFINITY } else { OUTSIDE_M.next_up() };
        found.clear();
        sample.zones.below(OUTSIDE_M.next_up(), limit_m, |pair, distance_m| {
            found.push(Nearest { distance_m, pair });
        });
        for &Nearest { distance_m, pair } in &self.found {
            self.pairs[pair].observe(distance_m, pair, sample);
        }
    }
}

fn watch(dof: usize) -> Watch {
    Watch::new(Quantity::Distance, SiUnit::Metre, Bound::Above, OUTSIDE_M, dof)
}

impl Monitor for ZoneMonitor {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        if self.samples == 0 {
            self.pairs = vec![watch(sample.joints.state().q.len()); sample.zones.pairs().len()];
            self.found.reserve(self.pairs.len());
        }
        self.samples += 1;
        // The first contact decides. Afterwards no distance can be less than 0, and only pairs that have not touched
        // are new.
        if !self.distance.is_violated() {
            let threshold_m = self.distance.worst().unwrap_or(f64::INFINITY);
            if let Some(nearest) = sample.zones.nearest_below(threshold_m) {
                self.distance.observe(nearest.distance_m, nearest.pair, sample);
            }
        }
        if self.distance.is_violated() {
            self.observe_touching(sample);
        }
    }

    /// The smallest distance, and then each further pair that touched.
    fn finish(&self, names: &Names) -> Observed {
        let nearest = self.distance.worst_subject();
        let pairs = self.pairs.iter().enumerate();
        let further = pairs.filter(|(pair, watch)| watch.is_violated() && Some(*pair) != nearest);
        let watches = std::iter::once(&self.distance).chain(further.map(|(_, watch)| watch));
        let measure = |watch: &Watch| watch.measure(&names.joints, |pair| names.zones[pair].clone());
        Observed { samples: self.samples, measures: watches.map(measure).collect(), ..Observed::default() }
    }

    fn has_failed(&self) -> bool {
        self.distance.is_violated()
    }
}
