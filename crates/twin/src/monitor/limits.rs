//! Joint positions against their limits.

use congruent_description::{Diagnostic, JointKind, RobotDescription, units::Unit};

use super::{
    monitor::{Monitor, Observed},
    names::Names,
    watch::Watch,
};
use crate::{
    sample::Sample,
    scenario::{FilePlace, LimitsCheck},
    verdict::Bound,
};

/// How far beyond a limit a joint counts as at it, rad and m, if the scenario does not say. Kind: digits of files. A
/// limit that is written with six decimals, 1.570796 for a quarter turn, is off by up to 5e-7, and steps that add
/// up to a limit by 1e-9 at most; what an encoder or a stop would notice is larger.
pub(crate) const AT_THE_LIMIT: f64 = 1e-6;

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

/// Whether each tolerance is given in one unit only.
pub(super) fn examine(check: &LimitsCheck, place: FilePlace<'_>) -> Result<(), Diagnostic> {
    let twice = [
        ("tolerance_rad", "tolerance_deg", check.tolerance_rad.and(check.tolerance_deg)),
        ("tolerance_m", "tolerance_mm", check.tolerance_m.and(check.tolerance_mm)),
    ];
    match twice.into_iter().find(|(.., both)| both.is_some()) {
        None => Ok(()),
        Some((si, other, _)) => {
            let message = format!("the tolerance is given twice, as {si} and as {other}");
            let error = Diagnostic::error("scenario::two_units", message).with_help("leave one of them out");
            Err(place.key(other).mark(error))
        }
    }
}

/// Of joints that turn, and of joints that slide.
fn tolerances(check: &LimitsCheck) -> [f64; 2] {
    let in_si = |si: Option<f64>, unit: Unit, value: Option<f64>| {
        si.or(value.map(|value| unit.convert(value))).unwrap_or(AT_THE_LIMIT)
    };
    [
        in_si(check.tolerance_rad, Unit::Angle, check.tolerance_deg),
        in_si(check.tolerance_m, Unit::Length, check.tolerance_mm),
    ]
}

impl LimitsMonitor {
    pub(super) fn new(check: &LimitsCheck, description: &RobotDescription) -> Self {
        let robot = &description.robot;
        let range = |(coordinate, &joint): (usize, _)| {
            let joint = robot.joint(joint);
            let (lower, upper) = joint.position_range()?;
            let is_angular = joint.kind != JointKind::Prismatic;
            Some(CoordinateRange { coordinate, lower, upper, is_angular })
        };
        let [angular, linear] = tolerances(check);
        let watch =
            |quantity, unit, tolerance| Watch::new(quantity, unit, Bound::AtMost, tolerance, robot.dof());
        Self {
            ranges: robot.movable_joints().iter().enumerate().filter_map(range).collect(),
            angular: watch(ANGLE_BEYOND_LIMIT, "rad", angular),
            linear: watch(SHIFT_BEYOND_LIMIT, "m", linear),
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
