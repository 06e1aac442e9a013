//! Motions along a path: lines and arcs of the TCP, many points, the playback of a table.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::profile::Profile;
use crate::{
    PoseSettings,
    number::{non_negative, optional_positive, positive},
    text::variant,
};

/// The TCP moves along a straight line in the world and rotates evenly along it; it keeps its orientation if no rotation
/// is given.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LineMotion {
    /// Pose of the TCP at the end of the line, in the world.
    pub line_tcp: PoseSettings,
    /// Speed of the TCP; it starts and ends at rest, unless it blends into the next motion.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub speed_m_s: Option<f64>,
    /// Duration of the motion, instead of a speed.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub duration_s: Option<f64>,
    /// Profile over `duration_s`, default quintic; not allowed with a speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub profile: Option<Profile>,
    /// Acceleration with a speed, along the path and across it; default 1.2 m/s^2.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub acceleration_m_s2: Option<f64>,
    /// Jerk with a speed; default: the acceleration is reached in 0.1 s.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub jerk_m_s3: Option<f64>,
    /// Distance from the end of the motion within which it blends into the next line or arc, without a stop.
    #[serde(default, deserialize_with = "non_negative")]
    pub blend_m: f64,
    /// Whether the orientation is controlled; arms of fewer than six joints may control the position alone.
    #[serde(default, deserialize_with = "variant", skip_serializing_if = "ToolOrientation::is_led")]
    pub orientation: ToolOrientation,
}

/// Whether the tool's orientation is controlled along a line, an arc or a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ToolOrientation {
    /// Controlled: the tool rotates evenly from the orientation at the start to that at the end, or keeps it if the end has none.
    #[default]
    Led,
    /// Not controlled: the position alone follows the path, and the orientation results. The end has no rotation.
    Free,
}

impl ToolOrientation {
    /// Whether it is the default, which is not written.
    #[expect(clippy::trivially_copy_pass_by_ref, reason = "serde calls it with a reference")]
    fn is_led(&self) -> bool {
        *self == Self::Led
    }
}

/// The end of an arc, and a point on it.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ArcSettings {
    /// A position on the arc between start and end, without a rotation.
    pub via: PoseSettings,
    /// Pose of the TCP at the end of the arc, in the world.
    pub to: PoseSettings,
}

/// The TCP moves along the arc of a circle from its present position through `via` to `to`; otherwise as for `line_tcp`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ArcMotion {
    /// A point on the arc and its end.
    pub arc_tcp: Box<ArcSettings>,
    /// Speed of the TCP; it starts and ends at rest, unless it blends into the next motion.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub speed_m_s: Option<f64>,
    /// Duration of the motion, instead of a speed.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub duration_s: Option<f64>,
    /// Profile over `duration_s`, default quintic; not allowed with a speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub profile: Option<Profile>,
    /// Acceleration with a speed, along the path and across it; default 1.2 m/s^2.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub acceleration_m_s2: Option<f64>,
    /// Jerk with a speed; default: the acceleration is reached in 0.1 s.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub jerk_m_s3: Option<f64>,
    /// Distance from the end of the motion within which it blends into the next line or arc, without a stop.
    #[serde(default, deserialize_with = "non_negative")]
    pub blend_m: f64,
    /// Whether the orientation is controlled; arms of fewer than six joints may control the position alone.
    #[serde(default, deserialize_with = "variant", skip_serializing_if = "ToolOrientation::is_led")]
    pub orientation: ToolOrientation,
}

/// The TCP moves along straight lines from point to point.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TcpPathMotion {
    /// Poses of the TCP, in the world; a pose without a rotation keeps the orientation of the pose before.
    pub path_tcp: Vec<PoseSettings>,
    /// Speed of the TCP.
    #[serde(deserialize_with = "positive")]
    pub speed_m_s: f64,
    /// Acceleration, along the path and across it; default 1.2 m/s^2.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub acceleration_m_s2: Option<f64>,
    /// Jerk; default: the acceleration is reached in 0.1 s.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub jerk_m_s3: Option<f64>,
    /// Distance from each inner point within which a line blends into the next; 0, the default, is a stop at the point.
    #[serde(default, deserialize_with = "non_negative")]
    pub blend_m: f64,
    /// Whether the orientation is controlled; arms of fewer than six joints may control the position alone.
    #[serde(default, deserialize_with = "variant", skip_serializing_if = "ToolOrientation::is_led")]
    pub orientation: ToolOrientation,
}

/// The joints pass many points with continuous acceleration (a cubic spline) and rest at the end; joints that a point does not
/// name keep the position of the point before.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointPathMotion {
    /// Angles in degrees by joint, for each point.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub path_joints_deg: Vec<BTreeMap<String, f64>>,
    /// Angles in radians by joint, for each point.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub path_joints_rad: Vec<BTreeMap<String, f64>>,
    /// Shifts in metres by joint, for each point.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub path_joints_m: Vec<BTreeMap<String, f64>>,
    /// Shifts in millimetres by joint, for each point.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub path_joints_mm: Vec<BTreeMap<String, f64>>,
    /// Time at which each point is passed, from the start of the motion.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub at_s: Vec<f64>,
    /// Duration of the whole path, if there are no times: points are then spaced by the time of the slowest joint. Without
    /// both, it is the least time of this spline within the limits.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub duration_s: Option<f64>,
}

/// Interpolation of the joints between the rows of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Between {
    /// A cubic spline: acceleration is continuous.
    #[default]
    Spline,
    /// Constant velocities from row to row.
    Linear,
}

/// The joints follow a table of positions, whose first row is their position at the start of the motion.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlaybackMotion {
    /// A CSV or Parquet file, relative to the scenario: a column `time_s`, and columns `JOINT_deg`, `_rad`, `_m` or `_mm`.
    pub play_csv: String,
    /// Interpolation of the joints between the rows.
    #[serde(default, deserialize_with = "variant")]
    pub between: Between,
}
