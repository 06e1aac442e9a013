//! Settings of the checks of forces.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::on_violation::OnViolation;
use crate::{
    number::{optional_inner_share, optional_positive, optional_share},
    text::variant,
};

/// The acceleration of the twin in each step, against forward dynamics by analysis at the twin's state and efforts.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DynamicsCheck {
    /// Largest difference, as torque, relative to the torques that act at the joint. The default is proportional to the length
    /// of a step: the physics integrates to first order.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub relative: Option<f64>,
    /// Share of all possible cases of `[uncertainty]` in which the check must pass, below 1; default: in every case of the run.
    #[serde(default, deserialize_with = "optional_inner_share", skip_serializing_if = "Option::is_none")]
    pub passing: Option<f64>,
    /// What the run does at the first violation of the check.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

/// The effort that each actuator delivers in a step, against the effort that it is commanded to; of a log, the recorded efforts against
/// inverse dynamics at the recorded motion.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EffortCheck {
    /// Largest difference relative to the commanded effort, which counts as at least a tenth of the largest one of the joint so
    /// far; default 0.05.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub relative: Option<f64>,
    /// Of a log: largest part of the variance of the effort of a joint that inverse dynamics, friction, armature and a factor leave;
    /// default 0.5.
    #[serde(default, deserialize_with = "optional_share", skip_serializing_if = "Option::is_none")]
    pub unexplained_share: Option<f64>,
    /// Share of all possible cases of `[uncertainty]` in which the check must pass, below 1; default: in every case of the run.
    #[serde(default, deserialize_with = "optional_inner_share", skip_serializing_if = "Option::is_none")]
    pub passing: Option<f64>,
    /// What the run does at the first violation of the check.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

/// Work of the actuators against the change of energy and the losses by damping and dry friction.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PowerCheck {
    /// Largest difference, relative to the energy that actuators and gravity have moved. The default is proportional to the
    /// length of a step: the physics integrates to first order.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub relative: Option<f64>,
    /// Share of all possible cases of `[uncertainty]` in which the check must pass, below 1; default: in every case of the run.
    #[serde(default, deserialize_with = "optional_inner_share", skip_serializing_if = "Option::is_none")]
    pub passing: Option<f64>,
    /// What the run does at the first violation of the check.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}
