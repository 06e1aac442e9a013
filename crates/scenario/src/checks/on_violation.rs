//! `on_violation`, a key of every check: what a run does when the check is violated first.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What the run does at the first violation of a check.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OnViolation {
    /// The run continues to its end, and the report has the worst value.
    #[default]
    Continue,
    /// The arm is brought to rest and the run ends: the setpoint continues on a straight line in joint space, all joints
    /// slowing down in proportion within their acceleration limits and ranges, and stays. The checks continue until the arm is
    /// at rest.
    Stop,
}
