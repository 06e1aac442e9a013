//! Forbidden zones: the convex shapes of the links that a zone names never touch it.

use congruent_description::RobotDescription;

use crate::{
    monitor::{Monitor, Names, Observed, watch::Watch},
    sample::Sample,
    verdict::Bound,
};

/// A link is outside a zone if its distance from it is above this.
const OUTSIDE_M: f64 = 0.0;

pub(crate) struct ZoneMonitor {
    distance: Watch,
    samples: u64,
}

impl ZoneMonitor {
    pub(crate) fn new(description: &RobotDescription) -> Self {
        let distance = Watch::new("distance", "m", Bound::Above, OUTSIDE_M, description.robot.dof());
        Self { distance, samples: 0 }
    }
}

impl Monitor for ZoneMonitor {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        self.samples += 1;
        if self.distance.is_violated() {
            return; // no distance is below 0: nothing can be worse
        }
        let threshold_m = self.distance.worst().unwrap_or(f64::INFINITY);
        if let Some(nearest) = sample.zones.nearest_below(threshold_m) {
            self.distance.observe(nearest.distance_m, nearest.pair, sample);
        }
    }

    fn finish(&self, names: &Names) -> Observed {
        let measure = self.distance.measure(&names.joints, |pair| names.zones[pair].clone());
        Observed { samples: self.samples, measures: vec![measure], ..Observed::default() }
    }

    fn has_failed(&self) -> bool {
        self.distance.is_violated()
    }
}
