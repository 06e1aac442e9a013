//! Model against twin: position and orientation of every link, at every sample.

use congruent_description::{Diagnostic, RobotDescription};
use serde::Deserialize;

use super::{Findings, Monitor, Names, watch::Watch};
use crate::{
    sample::Sample,
    scenario::{Positive, Section},
    verdict::Bound,
};

pub(super) const NAME: &str = "agreement";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    position_m: Option<Positive>,
    orientation_rad: Option<Positive>,
}

struct Agreement {
    position: Watch,
    orientation: Watch,
    limits: [f64; 2],
    samples: u64,
}

/// Limits that are not given are the robot file's tolerance.
pub(super) fn parse(
    section: Section<'_>,
    description: &RobotDescription,
) -> Result<Box<dyn Monitor>, Vec<Diagnostic>> {
    let written: Written = section.read()?;
    let dof = description.robot.dof();
    let position_m = written.position_m.map_or(description.tolerance.position_m, Positive::get);
    let orientation_rad =
        written.orientation_rad.map_or(description.tolerance.orientation_rad, Positive::get);
    Ok(Box::new(Agreement {
        position: Watch::new("position", "m", Bound::AtMost, position_m, dof),
        orientation: Watch::new("orientation", "rad", Bound::AtMost, orientation_rad, dof),
        limits: [position_m, orientation_rad],
        samples: 0,
    }))
}

impl Monitor for Agreement {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        self.samples += 1;
        for (link, error) in sample.errors.iter().enumerate() {
            self.position.observe(error.position_m, link, sample);
            self.orientation.observe(error.orientation_rad, link, sample);
        }
    }

    fn finish(&self, names: &Names) -> Findings {
        let name = |link: usize| names.links[link].clone();
        Findings {
            samples: self.samples,
            measures: vec![
                self.position.measure(&names.joints, name),
                self.orientation.measure(&names.joints, name),
            ],
            notes: Vec::new(),
        }
    }

    fn has_failed(&self) -> bool {
        self.position.is_violated() || self.orientation.is_violated()
    }

    fn resolved(&self) -> toml::Table {
        let [position_m, orientation_rad] = self.limits;
        toml::Table::from_iter([
            ("position_m".to_owned(), position_m.into()),
            ("orientation_rad".to_owned(), orientation_rad.into()),
        ])
    }
}
