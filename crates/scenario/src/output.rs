//! `[output]`: files that a run writes in addition to its report and its recording.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::number::optional_positive;

/// `[output]`: files that a run writes in addition to its report and its recording.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OutputSettings {
    /// Writes the state at each sample as a table, `trajectory.csv` or `trajectory.parquet`, or as a log of ROS 2, `trajectory.mcap`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub trajectory: Option<TrajectoryFormat>,
    /// Time from row to row, a multiple of the step; default: every step. The last sample is a row in any case.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub trajectory_period_s: Option<f64>,
}

/// The format of a trajectory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum TrajectoryFormat {
    /// Text: columns separated by commas, numbers with as many digits as it takes to read the same number back.
    Csv,
    /// Apache Parquet, without compression.
    Parquet,
    /// MCAP with the messages of ROS 2 that viewers know: joint states, TF, the description of the robot, and the checks as diagnostics.
    Mcap,
}

impl OutputSettings {
    /// Whether no file is requested.
    pub(super) fn is_default(&self) -> bool {
        *self == Self::default()
    }
}
