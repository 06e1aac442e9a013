//! `[controller]`: the controller of the twin.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::joint_numbers::JointNumbers;
use crate::scenario::number::optional_positive;

/// A controller by its name, and which keys belong to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ControllerKind {
    /// No actuation.
    Passive,
    /// Playback of the setpoints without dynamics.
    Kinematic,
    /// Given torques.
    Torque,
    /// A servo on velocity.
    Velocity,
    /// A servo on position and velocity.
    Pd,
    /// The same with the integral of the position error.
    Pid,
    /// A servo, and the torque that holds the declared robot against gravity.
    GravityCompensation,
    /// The torque by which the declared robot follows the setpoint.
    ComputedTorque,
}

/// Every controller by name.
pub(crate) const CONTROLLER_KINDS: [(&str, ControllerKind); 8] = [
    ("passive", ControllerKind::Passive),
    ("kinematic", ControllerKind::Kinematic),
    ("torque", ControllerKind::Torque),
    ("velocity", ControllerKind::Velocity),
    ("pd", ControllerKind::Pd),
    ("pid", ControllerKind::Pid),
    ("gravity_compensation", ControllerKind::GravityCompensation),
    ("computed_torque", ControllerKind::ComputedTorque),
];

impl ControllerKind {
    /// The controller of this name.
    pub(crate) fn find(name: &str) -> Option<Self> {
        CONTROLLER_KINDS.iter().find(|(known, _)| *known == name).map(|(_, kind)| *kind)
    }

    /// The names of all controllers.
    pub(crate) fn names() -> Vec<&'static str> {
        CONTROLLER_KINDS.iter().map(|(name, _)| *name).collect()
    }

    /// Whether a key of `[controller]` belongs to it.
    pub(crate) fn takes(self, key: &str) -> bool {
        let has_dynamics = !matches!(self, Self::Passive | Self::Kinematic);
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
    /// Its name.
    #[schemars(extend("enum" = ControllerKind::names()))]
    pub kind: String,
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
    /// Of `torque`: a CSV file of torques over time, added to `torque`: a column `time_s` and one for each joint, N m or
    /// N. Between the rows it is interpolated, before the first and after the last it holds. Relative to the scenario
    /// file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub torque_file: Option<String>,
    /// How often the controller reads the sensors and computes new torques, which hold in between; continuous if left
    /// out.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub rate_hz: Option<f64>,
    /// Time from reading the sensors to the torques that follow; none if left out.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub delay_s: Option<f64>,
}

impl Default for ControllerSettings {
    /// Playback of the motions without dynamics.
    fn default() -> Self {
        Self {
            kind: "kinematic".to_owned(),
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
