//! `on_violation`, a key of every check: what a run does when the check is violated first.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What follows the first violation of a check.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OnViolation {
    /// The run goes on to its end, and the report tells the worst.
    #[default]
    Continue,
    /// The run ends with the sample that shows the violation: the robot is driven no further.
    ///
    /// It ends, and does not hold its position, because holding would be a claim about brakes that no
    /// scenario declares: how far an arm travels until it stands is a property of the machine.
    /// What is reported is what was seen up to the violation, and nothing after it.
    Stop,
}
