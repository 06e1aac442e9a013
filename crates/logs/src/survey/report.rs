//! A survey as data: what `congruent describe LOG` prints as JSON.

use congruent_input::Finding;
use schemars::JsonSchema;
use serde::Serialize;

use crate::{
    event::{LogFormat, TopicContent},
    table_reading::TableReading,
};

/// What is in a log. Times are s from the log time of its first message on.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct LogSurvey {
    /// The file or folder.
    pub file: String,
    /// Its format.
    pub format: LogFormat,
    /// When its first message was recorded, as `2025-10-09T08:53:20Z`; `None` if its times do not count from 1970.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub begun: Option<String>,
    /// From its first to its last message, by the clock of the recorder, s.
    pub duration_s: f64,
    /// Number of messages, those that are not decoded among them; of a table the number of rows.
    pub messages: u64,
    /// Its topics, in the order in which they were met.
    pub topics: Vec<TopicSurvey>,
    /// How a table was read.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub table: Option<TableReading>,
    /// The description of a robot that was recorded last.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub description: Option<RobotInLog>,
    /// Joints and units, compared with those of a robot that was given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub robot: Option<RobotOfLog>,
    /// Number of parts that cannot be read.
    pub unreadable_parts: u64,
    /// What is wrong or suspicious.
    pub warnings: Vec<Finding>,
}

/// A topic of a log.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct TopicSurvey {
    /// Name.
    pub name: String,
    /// Type of its messages.
    #[serde(rename = "type")]
    pub message_type: String,
    /// Encoding of its messages.
    pub encoding: String,
    /// What is read of it.
    pub content: TopicContent,
    /// Number of messages.
    pub messages: u64,
    /// When they are; `None` without one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub times: Option<TopicTimes>,
    /// Messages of a type that is read which cannot be decoded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub undecoded: Option<UndecodedMessages>,
    /// Of joint states: the joints.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joints: Option<JointsSurvey>,
    /// Of poses and TF: the frames, at most 100.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub frames: Vec<FramePair>,
}

/// Messages that cannot be decoded.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct UndecodedMessages {
    /// How many.
    pub count: u64,
    /// Why the first cannot.
    pub reason: String,
}

/// Which of the two times of a message are judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ClockKind {
    /// The stamps of the sender.
    Stamp,
    /// The log times of the recorder: messages have no stamps, or several, as those of TF.
    Log,
}

/// The times of the messages of a topic.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct TopicTimes {
    /// Which times these are.
    pub clock: ClockKind,
    /// The earliest, s.
    pub from_s: f64,
    /// The latest, s.
    pub to_s: f64,
    /// Messages without a stamp among others that have one, those that cannot be decoded among them. Nothing below is of them.
    pub without_stamp: u64,
    /// Mean rate outside of gaps, repeated times counted once, Hz; `None` if all messages have one time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rate_hz: Option<f64>,
    /// The median of the first steps, s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub period_s: Option<f64>,
    /// Steps of more than five times the one that nine of ten of the first do not exceed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gaps: Option<GapsSurvey>,
    /// Messages that repeat one of the 64 before: the same stamp, the same values.
    pub repeated_messages: u64,
    /// Messages with the stamp of one of the 64 before and other values.
    pub repeated_stamps: u64,
    /// Messages whose time is before that of the message before.
    pub steps_back: u64,
    /// The largest of these steps, s.
    pub largest_step_back_s: f64,
    /// Steps back by more than a second, with which a new part begins that cannot be ordered with the one before.
    pub restarts: u64,
    /// Mean of log time minus stamp, s; negative if the clock of the sender is ahead.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mean_delay_s: Option<f64>,
}

/// Times without messages.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct GapsSurvey {
    /// How many.
    pub count: u64,
    /// All of them together, s.
    pub total_s: f64,
    /// The longest, s.
    pub longest_s: f64,
    /// Where the longest begins, s.
    pub longest_from_s: f64,
}

/// The joints of a topic.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct JointsSurvey {
    /// Each joint that a message names, in the order in which they were met; at most 1000.
    pub joints: Vec<LoggedJoint>,
    /// Messages that were decoded.
    pub messages: u64,
    /// Messages whose list of names is not that of the message before.
    pub order_changes: u64,
    /// Messages that lack a joint which others have.
    pub incomplete: u64,
    /// Messages with an array that is neither empty nor as long as the names. Their values are not counted below.
    pub wrong_lengths: u64,
    /// Messages without positions.
    pub without_positions: u64,
    /// Messages without velocities.
    pub without_velocities: u64,
    /// Messages without efforts.
    pub without_efforts: u64,
    /// Shares of NaN and of infinite values, 0 to 1.
    pub missing_values: MissingShares,
}

/// Shares of values that are NaN or infinite, 0 to 1; 0 if there is no value.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct MissingShares {
    /// Of positions.
    pub position: f64,
    /// Of velocities.
    pub velocity: f64,
    /// Of efforts.
    pub effort: f64,
}

/// A joint of a topic.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct LoggedJoint {
    /// Name as written.
    pub name: String,
    /// Messages of the topic that do not name it.
    pub missing_in: u64,
    /// Smallest and largest position as written; `None` without one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position_range: Option<[f64; 2]>,
    /// Largest speed as written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub largest_velocity: Option<f64>,
    /// Largest effort as written, without its sign.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub largest_effort: Option<f64>,
}

/// A frame whose pose is given in another.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, JsonSchema)]
pub struct FramePair {
    /// The frame in which it is given.
    pub frame: String,
    /// The frame whose pose it is; `None` if the messages do not name it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub child: Option<String>,
}

/// A description of a robot in a log.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct RobotInLog {
    /// The topic.
    pub topic: String,
    /// Name of the robot; `None` if the text has none, or is neither a URDF nor an MJCF.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub robot: Option<String>,
    /// Length of the text.
    pub bytes: usize,
    /// How many were recorded with another text than the one before.
    pub changes: u64,
}

/// The joints of a log against those of a robot.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct RobotOfLog {
    /// Name of the robot.
    pub robot: String,
    /// Topics with joints of the robot; several if its joints are on several topics, or under several prefixes.
    pub sources: Vec<JointSource>,
    /// Joints of the robot that no topic has; those that follow others are not missed.
    pub missing: Vec<String>,
    /// Joints of the log that are none of the robot.
    pub unknown: Vec<UnknownJoint>,
    /// In which unit the positions of joints that turn lie within their limits.
    pub position_unit: PositionUnit,
    /// Joints with limits, and how many recorded positions exceed them.
    pub limits: Vec<JointLimitsSurvey>,
}

/// Joints of a robot on one topic whose names have one prefix and one suffix more, or one prefix less, than in the robot.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct JointSource {
    /// The topic.
    pub topic: String,
    /// What the names in the log have before those of the robot.
    pub prefix: String,
    /// What they have behind them.
    pub suffix: String,
    /// What the names of the robot have before those in the log.
    pub prefix_of_robot: String,
    /// The joints, with their names in the robot.
    pub joints: Vec<String>,
}

/// A joint of a log that is none of the robot.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct UnknownJoint {
    /// Its topic.
    pub topic: String,
    /// Its name.
    pub name: String,
    /// The joint of the robot that it is probably meant to be.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nearest: Option<String>,
}

/// In which unit the positions of joints that turn are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PositionUnit {
    /// Nine of ten of all joints together lie within the limits as written: rad.
    Radian,
    /// A tenth or more lies beyond the limits as written, and within them as degrees.
    Degree,
    /// A tenth or more lies beyond the limits in both units.
    Neither,
    /// No joint with limits has a position.
    Unknown,
}

/// The positions of a joint against its limits.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct JointLimitsSurvey {
    /// Its name in the robot.
    pub joint: String,
    /// Number of positions.
    pub positions: u64,
    /// Share of them beyond the limits as written, 0 to 1.
    pub beyond: f64,
    /// Share beyond the limits if they are degrees; `None` if the joint slides.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beyond_as_degrees: Option<f64>,
    /// Share beyond the limits if they are mm; `None` if the joint turns.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beyond_as_millimetres: Option<f64>,
}
