//! What a log gives, one event after the other, whatever its format.

use std::sync::Arc;

use congruent_input::Diagnostic;
use schemars::JsonSchema;
use serde::Serialize;

use crate::table_reading::TableReading;

/// When something was recorded, and when it was true.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct EventTime {
    /// When the recorder had it, ns since 1970 or since the start of a table.
    pub log_ns: i64,
    /// When its sender says that it was true, on the clock of the sender; `None` if the message has no stamp, or the stamp 0.
    pub stamp_ns: Option<i64>,
    /// `log_ns` from the first message of the log on, s.
    pub log_s: f64,
    /// `stamp_ns` from the log time of the first message on, s.
    pub stamp_s: Option<f64>,
}

impl EventTime {
    /// The time with its seconds, counted from the log time of the first message.
    pub(crate) fn new(log_ns: i64, stamp_ns: Option<i64>, first_ns: i64) -> Self {
        let since = |ns: i64| seconds(ns.saturating_sub(first_ns));
        Self { log_ns, stamp_ns, log_s: since(log_ns), stamp_s: stamp_ns.map(since) }
    }
}

/// Nanoseconds in seconds.
pub(crate) fn seconds(ns: i64) -> f64 {
    // Whole seconds and the rest apart: a difference of a microsecond is kept over centuries.
    #[expect(clippy::cast_precision_loss, reason = "both parts are below 2^53")]
    let parts = [(ns / 1_000_000_000) as f64, (ns % 1_000_000_000) as f64];
    parts[0] + parts[1] / 1e9
}

/// A number of messages for a mean.
#[expect(clippy::cast_precision_loss, reason = "no log has 2^53 messages")]
pub(crate) fn float(count: u64) -> f64 {
    count as f64
}

/// One message of a log, or a part of the log without any.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum LogEvent {
    /// Positions, velocities and efforts of joints.
    Joints(LoggedJoints),
    /// A pose that may change: of a topic of poses, or an edge of TF.
    Pose(LoggedPose),
    /// An edge of TF that does not change from here on, until it is published again.
    StaticEdge(LoggedPose),
    /// A description of a robot as text.
    Description(LoggedDescription),
    /// A message of which the time alone is read.
    Other(OtherMessage),
    /// A part of the log that cannot be read.
    Gap(LogGap),
    /// So many messages that have come and cannot be read, or that their sender had and that have not come.
    Unusable(u64),
}

/// A message with joint states. The arrays are as in the log: each is as long as `names`, empty, or of a wrong length.
#[derive(Debug, Clone, PartialEq)]
pub struct LoggedJoints {
    /// Index of its topic.
    pub topic: usize,
    /// When.
    pub time: EventTime,
    /// Names of the joints, in the order of the arrays.
    pub names: Arc<[String]>,
    /// Positions as written, rad or m if the log obeys the conventions of ROS; NaN where one is missing.
    pub position: Vec<f64>,
    /// Velocities as written, rad/s or m/s by convention.
    pub velocity: Vec<f64>,
    /// Efforts as written: N m or N by convention, of some drivers the current in A.
    pub effort: Vec<f64>,
}

impl LoggedJoints {
    /// Whether an array is neither empty nor as long as the names: then which value is of which joint is unknown.
    pub fn has_wrong_length(&self) -> bool {
        let arrays = [&self.position, &self.velocity, &self.effort];
        arrays.iter().any(|array| !array.is_empty() && array.len() != self.names.len())
    }
}

/// A pose of a frame in another one.
#[derive(Debug, Clone, PartialEq)]
pub struct LoggedPose {
    /// Index of its topic.
    pub topic: usize,
    /// When.
    pub time: EventTime,
    /// Whether it is the first of its message: one of TF has several edges.
    pub is_first_of_message: bool,
    /// The frame in which the pose is given.
    pub frame: String,
    /// The frame whose pose it is; `None` if the message does not name it.
    pub child: Option<String>,
    /// Position of the child in `frame`, m by convention.
    pub child_in_frame_m: [f64; 3],
    /// Rotation from the child to `frame`, scalar first, as written.
    pub frame_from_child_wxyz: [f64; 4],
}

/// A description of a robot that was recorded.
#[derive(Debug, Clone, PartialEq)]
pub struct LoggedDescription {
    /// Index of its topic.
    pub topic: usize,
    /// When.
    pub time: EventTime,
    /// The text: URDF, or whatever else was published.
    pub text: String,
}

/// A message that is not decoded.
#[derive(Debug, Clone, PartialEq)]
pub struct OtherMessage {
    /// Index of its topic.
    pub topic: usize,
    /// When.
    pub time: EventTime,
    /// Why a message of a type that is read could not be decoded; `None` if its type is not read.
    pub fault: Option<String>,
}

/// A part of a log that cannot be read.
#[derive(Debug, Clone, PartialEq)]
pub struct LogGap {
    /// Log times of its first and last message, s from the first message of the log on, as far as the file says.
    pub between_s: Option<[f64; 2]>,
    /// What is wrong, with the file and the place in it.
    pub cause: Diagnostic,
}

/// What is read of the messages of a topic.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum TopicContent {
    /// Joint states.
    Joints,
    /// Poses of one frame.
    Pose,
    /// Edges of TF.
    Transforms,
    /// Edges of TF that do not change.
    StaticTransforms,
    /// A description of a robot.
    Description,
    /// Their times alone.
    TimesAlone,
}

/// The format of a log.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LogFormat {
    /// One or several files of MCAP.
    Mcap,
    /// One or several databases of SQLite, of a bag of rosbag2.
    Db3,
    /// A table in CSV.
    Table,
    /// A table in Parquet.
    Parquet,
    /// A dataset of LeRobot: episodes in Parquet, each with times of its own.
    #[serde(rename = "lerobot")]
    LeRobot,
    /// Joint states and poses in JSON, a line for each message.
    JsonLines,
    /// The stream of a robot of Universal Robots.
    Rtde,
}

/// A topic of a log.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LogTopic {
    /// Name, as `/joint_states`; of a table the name of the file.
    pub name: String,
    /// Type of its messages, as `sensor_msgs/msg/JointState`.
    pub message_type: String,
    /// Encoding of its messages, as `cdr`.
    pub encoding: String,
    /// What is read of them.
    pub content: TopicContent,
}

/// A log that is read once, from its beginning to its end, in bounded memory.
pub trait LogReader {
    /// The topics that were met so far; an index stays valid.
    fn topics(&self) -> &[LogTopic];

    /// The next event in the order of the file; `None` after the last.
    ///
    /// # Errors
    /// The rest cannot be read at all.
    fn next_event(&mut self) -> Result<Option<LogEvent>, Diagnostic>;

    /// Its format.
    fn format(&self) -> LogFormat;

    /// What was suspicious when it was opened.
    fn warnings(&self) -> &[Diagnostic] {
        &[]
    }

    /// How a table is read; `None` for another format.
    fn table(&self) -> Option<&TableReading> {
        None
    }
}
