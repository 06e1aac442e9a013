//! `[source]`: joint states that were recorded, in place of a simulation.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    number::{finite, optional_finite, optional_positive},
    pose::PoseSettings,
    text::{optional_variant, variant},
};

/// `[source]`: a log of the real robot, whose joint states the run takes. It excludes `[controller]`, `[[motion]]`, `[[fault]]` and the
/// length of a simulation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SourceSettings {
    /// The log: an MCAP, a table in CSV, or a folder that rosbag2 wrote, relative to the scenario file.
    pub log: String,
    /// Which of the two times of a message is its time; default: the stamp of its sender, where there is one.
    #[serde(default, deserialize_with = "optional_variant", skip_serializing_if = "Option::is_none")]
    pub clock: Option<LogClock>,
    /// Rate of the rows of a table without times.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub rate_hz: Option<f64>,
    /// The index of the episode of a dataset of LeRobot, or of a Parquet with a column `episode_index`, that is read alone; default: all,
    /// one after the other.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub episode: Option<u64>,
    /// The run begins with the first sample at this time; default: with the first of all.
    #[serde(default, deserialize_with = "optional_finite", skip_serializing_if = "Option::is_none")]
    pub from_s: Option<f64>,
    /// The run ends with the last sample up to this time; default: with the last of all.
    #[serde(default, deserialize_with = "optional_finite", skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
    /// Nothing is interpolated or differentiated across a longer time without samples; default: five periods of the topic, and at
    /// least 20 ms.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub maximum_gap_s: Option<f64>,
    /// Joints between base and tip that the log does not have, and that were at their `[start]` all the time. Any other of which there is
    /// no value fails the check `recording`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub held: Vec<String>,
    /// The topics with joint states; default: the topics with the joints of the robot, if no joint is on two of them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub joints: Vec<LoggedJointSettings>,
    /// Poses that the log has and that are compared with those of the model.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pose: Vec<LoggedPoseSettings>,
}

/// The clock by which the messages of a log are ordered.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LogClock {
    /// The stamps of the senders: when something was true.
    Stamp,
    /// The times of the recorder: when it had the message.
    Log,
}

/// `[[source.joints]]`: a topic with joint states.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoggedJointSettings {
    /// The topic; of a table the name of the file.
    pub topic: String,
    /// What its states are: measured, or commanded.
    #[serde(default, deserialize_with = "variant", skip_serializing_if = "is_default")]
    pub role: JointRole,
    /// What the names in the log have before those of the robot.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub prefix: String,
    /// What they have behind them.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub suffix: String,
    /// Names of joints of the robot with those of the log, for names that have more than a prefix or suffix.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub names: BTreeMap<String, String>,
    /// What its efforts are. They are compared with the limits of the robot only if they are torques.
    #[serde(default, deserialize_with = "variant", skip_serializing_if = "is_default")]
    pub effort: LoggedEffort,
    /// The unit of the positions of joints that turn; velocities are in the same unit per second.
    #[serde(default, deserialize_with = "variant", skip_serializing_if = "is_default")]
    pub position: AngleUnit,
}

/// What the joint states of a topic are.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum JointRole {
    /// What the encoders measured.
    #[default]
    Measured,
    /// What the joints were commanded to do.
    Setpoint,
}

/// What recorded efforts are.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LoggedEffort {
    /// Nobody says: drivers write torques, currents in A, and torques without gravity under one name.
    #[default]
    Unknown,
    /// Torques and forces at the joints, N m and N.
    Torque,
}

/// A unit of angles.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum AngleUnit {
    /// Radians.
    #[default]
    Rad,
    /// Degrees.
    Deg,
}

/// `[[source.pose]]`: poses of the log, as `frame_from_target`, against those of the model at the same instants.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoggedPoseSettings {
    /// The topic: of poses, or of TF.
    pub topic: String,
    /// Where the poses come from, which decides what they can show.
    #[serde(deserialize_with = "variant")]
    pub origin: PoseOrigin,
    /// The frame in which the messages give the pose; default: the only one of the topic.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame: Option<String>,
    /// The frame whose pose it is, of TF; default: the only one of the topic.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub child: Option<String>,
    /// The link of the robot that carries the frame of the poses; default: the link of the frame's name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from_link: Option<String>,
    /// The frame of the poses in that link; default: the same frame.
    #[serde(default, skip_serializing_if = "is_default")]
    pub link_from_frame: PoseSettings,
    /// The link that carries the target; default: the link of the child's name, else the tip.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub link: Option<String>,
    /// The target in its link; default: the same frame, and of the tip the TCP.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub link_from_target: Option<PoseSettings>,
    /// Whether the two frames were fitted to this log: a constant error of the base or the tool then cannot be seen.
    #[serde(default, skip_serializing_if = "is_default")]
    pub frames_are_fitted: bool,
    /// Is added to the times of the poses, which are on another clock than the joints.
    #[serde(default, deserialize_with = "finite", skip_serializing_if = "is_default")]
    pub offset_s: f64,
    /// By how much the clock of the poses is slow, s/s: is multiplied by their time and added to it.
    #[serde(default, deserialize_with = "finite", skip_serializing_if = "is_default")]
    pub drift: f64,
    /// Whether the poses have a position only, as of a reflector that a tracker follows.
    #[serde(default, skip_serializing_if = "is_default")]
    pub position_only: bool,
}

/// Where poses of a log come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PoseOrigin {
    /// Computed from the same joint states by a URDF, as of `robot_state_publisher`: they show whether that URDF is this robot, and
    /// nothing of the arm.
    Derived,
    /// Computed by the robot's controller: they show its calibration, its tool and its clock, but no error of an encoder.
    Controller,
    /// Measured by a tracker or a camera: the only source that sees the arm itself.
    Measured,
}

fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

impl SourceSettings {
    /// The source with all that can be left out left out.
    pub fn new(log: impl Into<String>) -> Self {
        Self {
            log: log.into(),
            clock: None,
            rate_hz: None,
            episode: None,
            from_s: None,
            until_s: None,
            maximum_gap_s: None,
            held: Vec::new(),
            joints: Vec::new(),
            pose: Vec::new(),
        }
    }
}
