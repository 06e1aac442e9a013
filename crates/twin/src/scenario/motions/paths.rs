//! Motions along a path: lines and arcs of the TCP, many points, the playback of a table.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::profile::Profile;
use crate::scenario::{
    number::{non_negative, optional_positive, positive},
    pose::PoseSettings,
    text::variant,
};

/// The TCP goes along a straight line in the world, turning evenly on the way; it keeps its orientation if no rotation
/// is given.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LineMotion {
    /// The pose at the end.
    pub line_tcp: PoseSettings,
    /// Speed of the TCP; it starts and ends at rest, unless a blend leads on.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub speed_m_s: Option<f64>,
    /// How long it takes, instead of a speed.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub duration_s: Option<f64>,
    /// The profile over `duration_s`, quintic if left out; a speed has its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub profile: Option<Profile>,
    /// Acceleration with a speed, along the path and across it; 1.2 m/s^2 if left out.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub acceleration_m_s2: Option<f64>,
    /// Jerk with a speed; what reaches the acceleration in 0.1 s if left out.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub jerk_m_s3: Option<f64>,
    /// Distance from its end within which it turns into the next line or arc, without a stop.
    #[serde(default, deserialize_with = "non_negative")]
    pub blend_m: f64,
    /// What becomes of the orientation; arms of few joints can lead the position alone.
    #[serde(default, deserialize_with = "variant", skip_serializing_if = "ToolOrientation::is_led")]
    pub orientation: ToolOrientation,
}

/// What becomes of the tool's orientation along a line, an arc or a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ToolOrientation {
    /// It turns evenly from that at the start to that at the end, or is kept if the end has none.
    #[default]
    Led,
    /// It is whatever the arm gives: the position alone is led. The end has no rotation.
    Free,
}

impl ToolOrientation {
    /// Whether it is what is left out.
    #[expect(clippy::trivially_copy_pass_by_ref, reason = "serde calls it with a reference")]
    fn is_led(&self) -> bool {
        *self == Self::Led
    }
}

/// The end of an arc, and a point on the way.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ArcSettings {
    /// A position between start and end; it has no rotation.
    pub via: PoseSettings,
    /// The pose at the end.
    pub to: PoseSettings,
}

/// The TCP goes along the arc of a circle through its position, `via` and `to`; otherwise as [`LineMotion`].
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ArcMotion {
    /// Where it goes.
    pub arc_tcp: Box<ArcSettings>,
    /// Speed of the TCP; it starts and ends at rest, unless a blend leads on.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub speed_m_s: Option<f64>,
    /// How long it takes, instead of a speed.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub duration_s: Option<f64>,
    /// The profile over `duration_s`, quintic if left out; a speed has its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub profile: Option<Profile>,
    /// Acceleration with a speed, along the path and across it; 1.2 m/s^2 if left out.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub acceleration_m_s2: Option<f64>,
    /// Jerk with a speed; what reaches the acceleration in 0.1 s if left out.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub jerk_m_s3: Option<f64>,
    /// Distance from its end within which it turns into the next line or arc, without a stop.
    #[serde(default, deserialize_with = "non_negative")]
    pub blend_m: f64,
    /// What becomes of the orientation; arms of few joints can lead the position alone.
    #[serde(default, deserialize_with = "variant", skip_serializing_if = "ToolOrientation::is_led")]
    pub orientation: ToolOrientation,
}

/// The TCP goes along straight lines from point to point.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TcpPathMotion {
    /// The poses; one without a rotation keeps the orientation of the one before.
    pub path_tcp: Vec<PoseSettings>,
    /// Speed of the TCP.
    #[serde(deserialize_with = "positive")]
    pub speed_m_s: f64,
    /// Acceleration, along the path and across it; 1.2 m/s^2 if left out.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub acceleration_m_s2: Option<f64>,
    /// Jerk; what reaches the acceleration in 0.1 s if left out.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub jerk_m_s3: Option<f64>,
    /// Distance from each point between within which a line turns into the next; without one it stops there.
    #[serde(default, deserialize_with = "non_negative")]
    pub blend_m: f64,
    /// What becomes of the orientation; arms of few joints can lead the position alone.
    #[serde(default, deserialize_with = "variant", skip_serializing_if = "ToolOrientation::is_led")]
    pub orientation: ToolOrientation,
}

/// The joints go through many points with continuous acceleration (a cubic spline) and rest at the end; joints that a
/// point does not name stay where the point before has them.
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
    /// When each point is passed, from the start of the motion.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub at_s: Vec<f64>,
    /// How long all of it takes, if there are no times: points are then spaced by the way of the slowest joint. If both
    /// are left out, it is the least time of this spline within the limits.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub duration_s: Option<f64>,
}

/// What joints do between the rows of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Between {
    /// A cubic spline: acceleration is continuous.
    #[default]
    Spline,
    /// Constant velocities.
    Linear,
}

/// The joints follow a table of positions, which starts where they stand.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlaybackMotion {
    /// A CSV file, relative to the scenario: a column `time_s`, and columns `JOINT_deg`, `_rad`, `_m` or `_mm`.
    pub play_csv: String,
    /// What joints do between its rows.
    #[serde(default, deserialize_with = "variant")]
    pub between: Between,
}
