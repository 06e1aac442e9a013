//! The joints of a robot at one instant, true, measured and commanded.

use congruent_description::RobotQ;

/// Positions, velocities and efforts of all movable joints of a robot at one instant.
#[derive(Debug, Clone, Copy)]
pub struct JointStateView<'a> {
    /// Positions of the movable joints, rad or m.
    pub q: &'a RobotQ,
    /// Velocities, rad/s or m/s; empty if the source has none.
    pub qd: &'a [f64],
    /// Efforts, N m or N; empty if the source has none.
    pub effort: &'a [f64],
}

/// The commanded state of the joints.
#[derive(Debug, Clone, Copy)]
pub struct SetpointView<'a> {
    /// Commanded positions of the movable joints, rad or m.
    pub q: &'a RobotQ,
    /// Commanded velocities, rad/s or m/s.
    pub qd: &'a [f64],
    /// Accelerations, rad/s^2 or m/s^2; 0 during a servo, which commands none.
    pub qdd: &'a [f64],
    /// Efforts that the actuators were commanded to exert in the step that led to the present instant, N m or N; empty if the source
    /// does not know them.
    pub effort: &'a [f64],
}

/// The joints of a robot at one instant.
#[derive(Debug, Clone, Copy)]
pub struct JointSample<'a> {
    /// The true state; `None` if the source knows what was measured alone, as a log or a live robot does.
    pub truth: Option<JointStateView<'a>>,
    /// The state that the robot's sensors give; it differs from the true one by the faults of encoders.
    pub measured: JointStateView<'a>,
    /// The commanded state; `None` if the source does not know it.
    pub setpoint: Option<SetpointView<'a>>,
    /// Efforts as they were recorded: torques, torques without gravity or currents, NaN where one is missing; empty if the source is no
    /// log, or has none.
    pub recorded_effort: &'a [f64],
}

impl<'a> JointSample<'a> {
    /// What was measured, without the truth and a setpoint.
    pub fn measured(state: JointStateView<'a>) -> Self {
        Self { truth: None, measured: state, setpoint: None, recorded_effort: &[] }
    }

    /// The state that limits are judged by: the true one, or the measured one of a source that has no other.
    pub fn state(&self) -> JointStateView<'a> {
        self.truth.unwrap_or(self.measured)
    }
}

/// The forces that acted on the joints in the step that led to the present instant.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum StepForces {
    /// Unknown: the source has no dynamics, or the robot was placed at its state.
    #[default]
    Unknown,
    /// Only the efforts of the sample, gravity, damping and friction of the joints.
    Declared,
    /// In addition, perhaps the stop of a joint or contact with an obstacle that is near.
    Constrained,
    /// In addition, contact with an obstacle.
    Contact,
}

/// A link and an obstacle that pushed each other in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactForce {
    /// The link, in the robot's order.
    pub link: usize,
    /// Number of the obstacle in the scenario.
    pub obstacle: usize,
    /// Mean normal force in the step, N.
    pub force_n: f64,
}

impl StepForces {
    /// Whether constraint forces may have acted, which the efforts do not include.
    pub(crate) fn are_constrained(self) -> bool {
        matches!(self, Self::Constrained | Self::Contact)
    }
}
