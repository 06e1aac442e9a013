//! Use of the actuators in a run: largest efforts, and times at their limits.

use congruent_description::Robot;
use congruent_input::{SiUnit, display::quantity};
use congruent_monitors::ActuatorLimits;
use congruent_simulation::World;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The use of one joint's actuator in a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ActuatorUse {
    /// Name of the joint.
    pub joint: String,
    /// Largest magnitude of the effort.
    pub largest_effort: f64,
    /// Limit of the effort; `None` if there is no limit.
    pub effort_limit: Option<f64>,
    /// Unit of the efforts: `N m` or `N`.
    #[schemars(with = "String")]
    pub unit: SiUnit,
    /// Share of the steps in which the controller commanded more than the limit of the effort.
    pub at_effort_limit: f64,
    /// Share of the steps in which the actuator would have driven the joint faster than its velocity limit.
    pub at_velocity_limit: f64,
}

impl ActuatorUse {
    /// The times at effort and velocity limits, in words; `None` if there were none. `duration_s` is that of the run.
    pub fn held_back(&self, duration_s: f64) -> Option<String> {
        let time = |share: f64| quantity(share * duration_s, "s");
        let limit = self.effort_limit.filter(|_| self.at_effort_limit > 0.0);
        let effort = limit.map(|limit| {
            format!(
                "at its effort limit of {} for {}, largest {}",
                quantity(limit, self.unit.symbol()),
                time(self.at_effort_limit),
                quantity(self.largest_effort, self.unit.symbol())
            )
        });
        let speed = (self.at_velocity_limit > 0.0)
            .then(|| format!("at its velocity limit for {}", time(self.at_velocity_limit)));
        let held: Vec<String> = effort.into_iter().chain(speed).collect();
        (!held.is_empty()).then(|| format!("{} {}", self.joint, held.join("; ")))
    }
}

/// Counts of all joints.
#[derive(Debug, Clone)]
pub(super) struct ActuatorCounts {
    steps: u64,
    joints: Vec<LimitCount>,
}

#[derive(Debug, Clone, Copy, Default)]
struct LimitCount {
    largest_effort: f64,
    at_effort_limit: u64,
    at_velocity_limit: u64,
}

impl ActuatorCounts {
    pub(super) fn new(dof: usize) -> Self {
        Self { steps: 0, joints: vec![LimitCount::default(); dof] }
    }

    /// Counts the last step.
    pub(super) fn observe(&mut self, world: &World) {
        self.steps += 1;
        for ((count, effort), saturation) in
            self.joints.iter_mut().zip(world.torque()).zip(world.saturations())
        {
            count.largest_effort = count.largest_effort.max(effort.abs());
            count.at_effort_limit += u64::from(saturation.effort);
            count.at_velocity_limit += u64::from(saturation.speed);
        }
    }

    /// The use of every actuator; `limits` are what they can do.
    pub(super) fn report(&self, robot: &Robot, limits: &[ActuatorLimits]) -> Vec<ActuatorUse> {
        #[expect(clippy::cast_precision_loss, reason = "steps are bounded far below 2^52")]
        // A run that failed in its first step has none: no division by zero.
        let share = |count: u64| count as f64 / self.steps.max(1) as f64;
        let joints = robot.movable_joints().iter().map(|&joint| robot.joint(joint));
        // A follower has no actuator.
        let rows = joints.zip(&self.joints).zip(limits).filter(|((joint, _), _)| joint.mimic.is_none());
        rows.map(|((joint, count), limits)| ActuatorUse {
            joint: joint.name.clone(),
            largest_effort: count.largest_effort,
            // Without a limit the largest effort is `f64::MAX`.
            effort_limit: (limits.effort < f64::MAX).then_some(limits.effort),
            unit: if joint.kind.is_angular() { SiUnit::NewtonMetre } else { SiUnit::Newton },
            at_effort_limit: share(count.at_effort_limit),
            at_velocity_limit: share(count.at_velocity_limit),
        })
        .collect()
    }
}
