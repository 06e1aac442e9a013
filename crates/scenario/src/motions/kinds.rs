//! `[[motion]]`: the motions of a scenario, one after another. The keys of a motion determine its kind.

use std::collections::BTreeMap;

use congruent_input::serde_name;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    paths::{ArcMotion, JointPathMotion, LineMotion, PlaybackMotion, TcpPathMotion},
    profile::Profile,
};
use crate::{
    PoseSettings,
    number::{optional_positive, positive},
};

/// One motion, by the key that it has.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum MotionSettings {
    /// Named joints move to absolute positions.
    Joints(JointMotion),
    /// The joints move together to a configuration that has the TCP at a pose.
    Tcp(TcpMotion),
    /// The TCP moves along a straight line.
    Line(LineMotion),
    /// The TCP moves along an arc of a circle.
    Arc(ArcMotion),
    /// The TCP moves along straight lines from point to point.
    TcpPath(TcpPathMotion),
    /// The joints pass many points along a spline.
    JointPath(JointPathMotion),
    /// The joints follow a table.
    Playback(PlaybackMotion),
    /// The TCP is driven to a pose in a closed loop.
    Servo(ServoMotion),
}

impl MotionSettings {
    /// The kind of the motion: its key, without a unit.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Joints(_) => "move_joints",
            Self::Tcp(_) => TCP_KEY,
            Self::Line(_) => LINE_KEY,
            Self::Arc(_) => ARC_KEY,
            Self::TcpPath(_) => TCP_PATH_KEY,
            Self::JointPath(_) => "path_joints",
            Self::Playback(_) => PLAYBACK_KEY,
            Self::Servo(_) => SERVO_KEY,
        }
    }

    /// Duration of the motion, if the scenario gives it.
    pub fn duration_s(&self) -> Option<f64> {
        match self {
            Self::Joints(motion) => motion.duration_s,
            Self::Tcp(motion) => motion.duration_s,
            Self::Line(motion) => motion.duration_s,
            Self::Arc(motion) => motion.duration_s,
            Self::JointPath(motion) => motion.at_s.last().copied().or(motion.duration_s),
            Self::TcpPath(_) | Self::Playback(_) => None,
            Self::Servo(motion) => Some(motion.duration_s),
        }
    }
}

/// Named joints move to absolute positions, the others keep theirs.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointMotion {
    /// Angles in degrees by joint.
    // Written even if it is empty: a motion that moves no joint is recognised by this key alone.
    #[serde(default)]
    pub move_joints_deg: BTreeMap<String, f64>,
    /// Angles in radians by joint.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub move_joints_rad: BTreeMap<String, f64>,
    /// Shifts in metres by joint.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub move_joints_m: BTreeMap<String, f64>,
    /// Shifts in millimetres by joint.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub move_joints_mm: BTreeMap<String, f64>,
    /// Duration of the motion; default: the least time within the limits.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub duration_s: Option<f64>,
    /// Profile of the motion over its duration.
    #[serde(default)]
    pub profile: Profile,
}

/// The TCP moves to a pose in the world: the nearest solution of inverse kinematics is taken and the joints
/// move there together, so the path of the TCP is not a straight line.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TcpMotion {
    /// The pose, or the position if no rotation is given.
    pub move_tcp: PoseSettings,
    /// Duration of the motion; default: the least time within the limits.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub duration_s: Option<f64>,
    /// Profile of the motion over its duration.
    #[serde(default)]
    pub profile: Profile,
}

/// The TCP is driven to a pose, or to a position, by differential inverse kinematics in the loop.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ServoMotion {
    /// The pose, or the position if no rotation is given.
    pub servo_tcp: PoseSettings,
    /// How joint velocities are computed from the error.
    #[serde(default)]
    pub method: ServoMethod,
    /// Rate at which the error decays; default 5 per second.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub gain_per_s: Option<f64>,
    /// Duration of the servo motion.
    #[serde(deserialize_with = "positive")]
    pub duration_s: f64,
}

/// How joint velocities are computed from the error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ServoMethod {
    /// By the pseudo-inverse of the Jacobian, damped if the arm is nearly singular.
    #[default]
    PseudoInverse,
    /// By the transpose of the Jacobian.
    Transpose,
}

impl ServoMethod {
    /// The word of files and reports.
    pub fn word(self) -> &'static str {
        serde_name(&self)
    }
}

/// The keys of joint moves, one for each unit: they determine the kind of a motion, as the other keys below do.
pub(crate) const JOINT_KEYS: [&str; 4] =
    ["move_joints_deg", "move_joints_rad", "move_joints_m", "move_joints_mm"];
/// The key of [`TcpMotion`].
pub(crate) const TCP_KEY: &str = "move_tcp";
/// The key of [`ServoMotion`].
pub(crate) const SERVO_KEY: &str = "servo_tcp";
/// The key of [`LineMotion`].
pub(crate) const LINE_KEY: &str = "line_tcp";
/// The key of [`ArcMotion`].
pub(crate) const ARC_KEY: &str = "arc_tcp";
/// The key of [`TcpPathMotion`].
pub(crate) const TCP_PATH_KEY: &str = "path_tcp";
/// The keys of [`JointPathMotion`], one for each unit.
pub(crate) const JOINT_PATH_KEYS: [&str; 4] =
    ["path_joints_deg", "path_joints_rad", "path_joints_m", "path_joints_mm"];
/// The key of [`PlaybackMotion`].
pub(crate) const PLAYBACK_KEY: &str = "play_csv";
