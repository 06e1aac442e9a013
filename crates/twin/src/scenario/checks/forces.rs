//! Checks of forces.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::on_violation::OnViolation;
use crate::scenario::{number::optional_positive, text::variant};

/// The acceleration of the twin in each step, against forward dynamics by analysis at the twin's state and efforts.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DynamicsCheck {
    /// Largest difference, as torque, relative to the torques that act at the joint. Proportional to the length of a step if it
    /// is left out: the physics integrates to first order.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub relative: Option<f64>,
    /// What follows its first violation.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

/// Work of the actuators against the change of energy and what damping and dry friction take.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PowerCheck {
    /// Largest difference, relative to the energy that actuators and gravity have moved. Proportional to the length of a step if it is
    /// left out: the physics integrates to first order.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub relative: Option<f64>,
    /// What follows its first violation.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}
