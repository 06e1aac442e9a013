//! Forbidden zones: the convex shapes of the links that a zone names never touch it.

use congruent_description::{Diagnostic, RobotDescription};
use serde::Deserialize;

use super::{Findings, Monitor, Names, watch::Watch};
use crate::{sample::Sample, scenario::Section, verdict::Bound};

pub(crate) const NAME: &str = "zone";

/// A link is outside a zone as long as it has this distance and more from it.
const OUTSIDE_M: f64 = 0.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {}

struct Zone {
    distance: Watch,
    samples: u64,
}

pub(super) fn parse(
    section: Section<'_>,
    description: &RobotDescription,
) -> Result<Box<dyn Monitor>, Vec<Diagnostic>> {
    let Written {} = section.read()?;
    let distance = Watch::new("distance", "m", Bound::Above, OUTSIDE_M, description.robot.dof());
    Ok(Box::new(Zone { distance, samples: 0 }))
}

impl Monitor for Zone {
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

    fn finish(&self, names: &Names) -> Findings {
        let measure = self.distance.measure(&names.joints, |pair| names.zones[pair].clone());
        Findings { samples: self.samples, measures: vec![measure], notes: Vec::new() }
    }

    fn has_failed(&self) -> bool {
        self.distance.is_violated()
    }

    fn resolved(&self) -> toml::Table {
        toml::Table::new()
    }
}
