//! `on_violation`, a key of every check: what a run does when the check is violated first.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What follows the first violation of a check.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OnViolation {
    /// The run continues to its end, and the report has the worst value.
    #[default]
    Continue,
    /// The run ends with the sample that shows the violation: the robot is driven no further.
    ///
    /// The robot does not hold its position after it, since that would assume brakes that no scenario
    /// declares: the distance in which an arm comes to rest is a property of the machine. The report covers
    /// the run up to the violation.
    Stop,
}
