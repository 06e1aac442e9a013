//! `[controller]`: the controller of the twin.

use congruent_input::serde_name;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::joint_numbers::JointNumbers;
use crate::number::optional_positive;

/// A controller by its name, and which keys belong to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ControllerKind {
    /// None: the joint states are those of `[source]`. It has no name in scenarios.
    Absent,
    /// No actuation: the joints move freely.
    Passive,
    /// Playback of the setpoints without dynamics.
    Kinematic,
    /// Torques that the scenario gives, without feedback.
    Torque,
    /// Feedback of the velocity error.
    Velocity,
    /// Feedback of position and velocity error.
    Pd,
    /// Feedback of position and velocity error and of the integral of the position error.
    Pid,
    /// Feedback of position and velocity error, and the gravity torque of the declared robot.
    GravityCompensation,
    /// The torque by which the declared robot follows the setpoint.
    ComputedTorque,
}

/// Every controller, in the order of lists for people.
pub const CONTROLLER_KINDS: [ControllerKind; 8] = [
    ControllerKind::Passive,
    ControllerKind::Kinematic,
    ControllerKind::Torque,
    ControllerKind::Velocity,
    ControllerKind::Pd,
    ControllerKind::Pid,
    ControllerKind::GravityCompensation,
    ControllerKind::ComputedTorque,
];

impl ControllerKind {
    /// Whether it drives the robot by efforts.
    pub fn has_actuators(self) -> bool {
        !matches!(self, Self::Absent | Self::Passive | Self::Kinematic)
    }

    /// The name in scenarios.
    pub fn name(self) -> &'static str {
        serde_name(&self)
    }

    /// The controller of this name.
    pub fn find(name: &str) -> Option<Self> {
        CONTROLLER_KINDS.into_iter().find(|kind| kind.name() == name)
    }

    /// The names of all controllers.
    pub fn names() -> Vec<&'static str> {
        CONTROLLER_KINDS.map(Self::name).to_vec()
    }

    /// Whether a key of `[controller]` belongs to it.
    pub fn takes(self, key: &str) -> bool {
        let has_dynamics = self.has_actuators();
        match key {
            "stiffness" => {
                matches!(self, Self::Pd | Self::Pid | Self::GravityCompensation | Self::ComputedTorque)
            }
            "damping" => has_dynamics && self != Self::Torque,
            "integral" => self == Self::Pid,
            "torque" | "torque_file" => self == Self::Torque,
            _ => has_dynamics,
        }
    }
}

/// `[controller]`: the controller of the twin. Gains and torques are a number for all joints, or a table by joint in
/// which `others` holds for the joints that it does not name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ControllerSettings {
    /// Kind of the controller.
    #[schemars(with = "String", extend("enum" = ControllerKind::names()))]
    pub kind: ControllerKind,
    /// Torque per position error: N m/rad, N/m. Of `computed_torque`: acceleration per position error, 1/s^2.
    #[serde(default)]
    pub stiffness: JointNumbers,
    /// Torque per velocity error: N m s/rad, N s/m. Of `computed_torque`: acceleration per velocity error, 1/s.
    #[serde(default)]
    pub damping: JointNumbers,
    /// Of `pid`: torque per integral of the position error: N m/(rad s), N/(m s).
    #[serde(default, skip_serializing_if = "JointNumbers::is_zero")]
    pub integral: JointNumbers,
    /// Of `torque`: N m, N.
    #[serde(default, skip_serializing_if = "JointNumbers::is_zero")]
    pub torque: JointNumbers,
    /// Of `torque`: a CSV or Parquet file of torques over time, added to `torque`: a column `time_s` and one for each joint, N m or
    /// N. Between the rows it is interpolated, before the first and after the last it holds. Relative to the scenario
    /// file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub torque_file: Option<String>,
    /// Rate at which the controller reads the sensors and computes new torques, which it holds in between; default: every step
    /// of the physics, without a hold.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub rate_hz: Option<f64>,
    /// Time from reading the sensors to the output of the torques; default: no delay.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub delay_s: Option<f64>,
}

impl ControllerSettings {
    /// No controller, beside `[source]`.
    pub(crate) fn absent() -> Self {
        Self { kind: ControllerKind::Absent, ..Self::default() }
    }

    /// Whether there is none.
    pub(crate) fn is_absent(&self) -> bool {
        self.kind == ControllerKind::Absent
    }
}

impl Default for ControllerSettings {
    /// Playback of the motions without dynamics.
    fn default() -> Self {
        Self {
            kind: ControllerKind::Kinematic,
            stiffness: JointNumbers::default(),
            damping: JointNumbers::default(),
            integral: JointNumbers::default(),
            torque: JointNumbers::default(),
            torque_file: None,
            rate_hz: None,
            delay_s: None,
        }
    }
}
