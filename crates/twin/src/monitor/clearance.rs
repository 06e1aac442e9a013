//! Distance between links and to obstacles: never below a minimum.

use congruent_description::RobotDescription;

use super::{
    monitor::{Monitor, Observed},
    names::Names,
    watch::Watch,
};
use crate::{sample::Sample, scenario::ClearanceCheck, verdict::Bound};

pub(super) struct ClearanceMonitor {
    distance: Watch,
    minimum_m: f64,
    samples: u64,
}

impl ClearanceMonitor {
    pub(super) fn new(check: &ClearanceCheck, description: &RobotDescription) -> Self {
        let minimum_m = check.minimum_m;
        let distance = Watch::new("distance", "m", Bound::AtLeast, minimum_m, description.robot.dof());
        Self { distance, minimum_m, samples: 0 }
    }
}

impl Monitor for ClearanceMonitor {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        self.samples += 1;
        // Only a distance below the smallest so far, or below the minimum, changes the report; touching is
        // reported although no distance is below zero.
        let threshold_m = match self.distance.worst() {
            Some(worst_m) if self.distance.is_violated() => worst_m,
            Some(worst_m) => worst_m.max(self.minimum_m),
            None => f64::INFINITY,
        };
        if let Some(nearest) = sample.clearance.nearest_below(threshold_m) {
            self.distance.observe(nearest.distance_m, nearest.pair, sample);
        }
    }

    fn finish(&self, names: &Names) -> Observed {
        let notes = if names.pairs.is_empty() {
            vec!["no pair to check: neighbouring bodies and disabled pairs are left out".to_owned()]
        } else {
            Vec::new()
        };
        let measure = self.distance.measure(&names.joints, |pair| names.pairs[pair].clone());
        Observed { samples: self.samples, measures: vec![measure], notes }
    }

    fn has_failed(&self) -> bool {
        self.distance.is_violated()
    }
}
