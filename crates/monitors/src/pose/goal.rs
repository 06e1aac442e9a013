//! The goal: the target of the twin's tool centre point at the end of the scenario. If the run ends
//! early, the check is skipped.

use congruent_description::{LinkIndex, RobotDescription};
use congruent_input::{Diagnostic, Quantity, SiUnit};
use congruent_kinematics::{Pose, PoseError};
use congruent_scenario::{FilePlace, GoalCheck};
use nalgebra::Isometry3;

use crate::{
    Names, codes,
    monitor::{Monitor, Observed},
    sample::Sample,
    verdict::Bound,
    watch::Watch,
};

pub(crate) struct GoalMonitor {
    world_from_target: Pose,
    tip: LinkIndex,
    tip_from_tcp: Isometry3<f64>,
    position: Watch,
    /// `None` if the goal has no rotation.
    orientation: Option<Watch>,
    samples: u64,
}

/// Checks that a pose has both tolerances, and a position only the first.
pub(crate) fn examine(check: &GoalCheck, place: FilePlace<'_>) -> Result<Isometry3<f64>, Diagnostic> {
    let [position, orientation] = check.unit_keys();
    position.required(place)?;
    let place = place.key("tcp");
    let world_from_target = check.tcp.target(place)?;
    if check.tcp.has_rotation() == orientation.value().is_some() {
        return Ok(world_from_target);
    }
    let message = if check.tcp.has_rotation() {
        "the goal has a rotation, but no tolerance `orientation_rad` (or `orientation_deg`)"
    } else {
        "`orientation_rad` (or `orientation_deg`) is the tolerance of a rotation, but the goal has no rotation"
    };
    let error = Diagnostic::error(codes::scenario::GOAL, message);
    Err(place.mark(error.with_help(
        "for a pose give `tcp` a rotation and a tolerance of the orientation; for a position give neither",
    )))
}

impl GoalMonitor {
    /// # Panics
    /// For a goal that [`examine`] rejects.
    pub(crate) fn new(check: &GoalCheck, description: &RobotDescription) -> Self {
        let world_from_target = examine(check, FilePlace::nowhere()).expect("a setup examines its checks");
        let [position, orientation] = check.unit_keys().map(|keys| keys.value());
        let watch = |quantity, unit, limit: f64| {
            Watch::new(quantity, unit, Bound::AtMost, limit, description.robot.dof())
        };
        Self {
            world_from_target: Pose::from(world_from_target),
            tip: description.tip,
            tip_from_tcp: description.tip_from_tcp.unwrap_or_else(Isometry3::identity),
            position: watch(
                Quantity::Position,
                SiUnit::Metre,
                position.expect("a setup examines its checks"),
            ),
            orientation: orientation.map(|limit| watch(Quantity::Orientation, SiUnit::Radian, limit)),
            samples: 0,
        }
    }
}

impl Monitor for GoalMonitor {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        if !sample.is_last {
            return;
        }
        self.samples += 1;
        let world_from_tcp = sample.twin[self.tip.get()] * self.tip_from_tcp;
        let PoseError { position_m, orientation_rad } =
            PoseError::to_isometry(&self.world_from_target, &world_from_tcp);
        self.position.observe(position_m, self.tip.get(), sample);
        if let Some(watch) = &mut self.orientation {
            watch.observe(orientation_rad, self.tip.get(), sample);
        }
    }

    fn finish(&self, names: &Names) -> Observed {
        let watches = std::iter::once(&self.position).chain(&self.orientation);
        let measure = |watch: &Watch| watch.measure(&names.joints, |link| names.links[link].clone());
        Observed { samples: self.samples, measures: watches.map(measure).collect(), ..Observed::default() }
    }

    fn has_failed(&self) -> bool {
        std::iter::once(&self.position).chain(&self.orientation).any(Watch::is_violated)
    }
}
