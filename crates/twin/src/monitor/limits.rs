//! Joint positions: never outside their limits.

use congruent_description::{Diagnostic, JointKind, RobotDescription};
use serde::Deserialize;

use super::{Findings, Monitor, Names, watch::Watch};
use crate::{sample::Sample, scenario::Section, verdict::Bound};

pub(super) const NAME: &str = "limits";

/// Kind: rounding. A joint that rests at its limit is there to rounding: adding up 1e6 steps of
/// at most 1e-16 each stays below this.
const AT_THE_LIMIT: f64 = 1e-9;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {}

/// The range of one coordinate.
struct Range {
    coordinate: usize,
    lower: f64,
    upper: f64,
    is_angular: bool,
}

struct Limits {
    ranges: Vec<Range>,
    angular: Watch,
    linear: Watch,
    samples: u64,
}

pub(super) fn parse(
    section: Section<'_>,
    description: &RobotDescription,
) -> Result<Box<dyn Monitor>, Vec<Diagnostic>> {
    let Written {} = section.read()?;
    let robot = &description.robot;
    let range = |(coordinate, &joint): (usize, _)| {
        let joint = robot.joint(joint);
        let (lower, upper) = joint.position_range()?;
        Some(Range { coordinate, lower, upper, is_angular: joint.kind != JointKind::Prismatic })
    };
    let watch = |quantity, unit| Watch::new(quantity, unit, Bound::AtMost, AT_THE_LIMIT, robot.dof());
    Ok(Box::new(Limits {
        ranges: robot.movable_joints().iter().enumerate().filter_map(range).collect(),
        angular: watch("angle_beyond_limit", "rad"),
        linear: watch("shift_beyond_limit", "m"),
        samples: 0,
    }))
}

impl Monitor for Limits {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        self.samples += 1;
        for range in &self.ranges {
            let q = sample.q[range.coordinate];
            let beyond = (range.lower - q).max(q - range.upper);
            let watch = if range.is_angular { &mut self.angular } else { &mut self.linear };
            watch.observe(beyond, range.coordinate, sample);
        }
    }

    fn finish(&self, names: &Names) -> Findings {
        let name = |coordinate: usize| names.joints[coordinate].clone();
        let measures = [&self.angular, &self.linear]
            .into_iter()
            .filter(|watch| watch.worst().is_some())
            .map(|watch| watch.measure(&names.joints, name))
            .collect();
        let notes = if self.ranges.is_empty() { vec!["no joint has limits".to_owned()] } else { Vec::new() };
        Findings { samples: self.samples, measures, notes }
    }

    fn has_failed(&self) -> bool {
        self.angular.is_violated() || self.linear.is_violated()
    }

    fn resolved(&self) -> toml::Table {
        toml::Table::new()
    }
}
