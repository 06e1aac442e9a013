//! Joint positions against their limits.

use congruent_description::{JointKind, RobotDescription};

use super::{
    monitor::{Monitor, Observed},
    names::Names,
    watch::Watch,
};
use crate::{sample::Sample, verdict::Bound};

/// Kind: rounding. A joint that rests at its limit is there to rounding: adding up 1e6 steps of
/// at most 1e-16 each stays below this.
const AT_THE_LIMIT: f64 = 1e-9;

/// How far a joint that turns is beyond its limit; negative inside its range.
pub(crate) const ANGLE_BEYOND_LIMIT: &str = "angle_beyond_limit";
/// The same of a joint that shifts.
pub(crate) const SHIFT_BEYOND_LIMIT: &str = "shift_beyond_limit";

/// The range of one coordinate.
struct CoordinateRange {
    coordinate: usize,
    lower: f64,
    upper: f64,
    is_angular: bool,
}

pub(super) struct LimitsMonitor {
    ranges: Vec<CoordinateRange>,
    angular: Watch,
    linear: Watch,
    samples: u64,
}

impl LimitsMonitor {
    pub(super) fn new(description: &RobotDescription) -> Self {
        let robot = &description.robot;
        let range = |(coordinate, &joint): (usize, _)| {
            let joint = robot.joint(joint);
            let (lower, upper) = joint.position_range()?;
            let is_angular = joint.kind != JointKind::Prismatic;
            Some(CoordinateRange { coordinate, lower, upper, is_angular })
        };
        let watch = |quantity, unit| Watch::new(quantity, unit, Bound::AtMost, AT_THE_LIMIT, robot.dof());
        Self {
            ranges: robot.movable_joints().iter().enumerate().filter_map(range).collect(),
            angular: watch(ANGLE_BEYOND_LIMIT, "rad"),
            linear: watch(SHIFT_BEYOND_LIMIT, "m"),
            samples: 0,
        }
    }
}

impl Monitor for LimitsMonitor {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        self.samples += 1;
        for range in &self.ranges {
            let q = sample.joints.truth.q[range.coordinate];
            let beyond = (range.lower - q).max(q - range.upper);
            let watch = if range.is_angular { &mut self.angular } else { &mut self.linear };
            watch.observe(beyond, range.coordinate, sample);
        }
    }

    fn finish(&self, names: &Names) -> Observed {
        let name = |coordinate: usize| names.joints[coordinate].clone();
        let measures = [&self.angular, &self.linear]
            .into_iter()
            .filter(|watch| watch.worst().is_some())
            .map(|watch| watch.measure(&names.joints, name))
            .collect();
        let notes = if self.ranges.is_empty() { vec!["no joint has limits".to_owned()] } else { Vec::new() };
        Observed { samples: self.samples, measures, notes }
    }

    fn has_failed(&self) -> bool {
        self.angular.is_violated() || self.linear.is_violated()
    }
}
