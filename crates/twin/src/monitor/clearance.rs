//! Distance between links and to obstacles: never below a minimum.

use congruent_description::{Diagnostic, RobotDescription};
use serde::Deserialize;

use super::{Findings, Monitor, Names, watch::Watch};
use crate::{
    sample::Sample,
    scenario::{NonNegative, Section},
    verdict::Bound,
};

pub(super) const NAME: &str = "clearance";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    minimum_m: NonNegative,
}

struct Clearance {
    distance: Watch,
    minimum_m: f64,
    samples: u64,
}

pub(super) fn parse(
    section: Section<'_>,
    description: &RobotDescription,
) -> Result<Box<dyn Monitor>, Vec<Diagnostic>> {
    let Written { minimum_m } = section.read()?;
    let minimum_m = minimum_m.get();
    let distance = Watch::new("distance", "m", Bound::AtLeast, minimum_m, description.robot.dof());
    Ok(Box::new(Clearance { distance, minimum_m, samples: 0 }))
}

impl Monitor for Clearance {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        self.samples += 1;
        // Only what is closer than ever, or too close, changes what is reported; touching is
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

    fn finish(&self, names: &Names) -> Findings {
        let notes = if names.pairs.is_empty() {
            vec!["no pair to watch: neighbouring bodies and disabled pairs are left out".to_owned()]
        } else {
            Vec::new()
        };
        let measure = self.distance.measure(&names.joints, |pair| names.pairs[pair].clone());
        Findings { samples: self.samples, measures: vec![measure], notes }
    }

    fn has_failed(&self) -> bool {
        self.distance.is_violated()
    }

    fn resolved(&self) -> toml::Table {
        toml::Table::from_iter([("minimum_m".to_owned(), self.minimum_m.into())])
    }
}
