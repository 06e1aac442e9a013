//! What is said of a stream: a line for each thing, as JSON.

use congruent_input::{Quantity, SiUnit};
use congruent_monitors::verdict::{Bound, Verdict};
use congruent_results::report::RunReport;
use congruent_scenario::{CheckKind, PoseOrigin};
use schemars::JsonSchema;
use serde::Serialize;

use super::latency::LatencyReport;

/// One line of the answer to a stream. Times are those of the stream.
#[derive(Debug, Clone, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum WatchLine {
    /// The first line: what was found in the stream and is judged.
    Started(WatchStart),
    /// The pose of the TCP at a sample.
    Pose(WatchedPose),
    /// A value of a check is outside its limit.
    Violation(CheckChange),
    /// It is within its limit again. The verdict of the run stays.
    Recovered(CheckChange),
    /// A time without samples, in which nothing was judged.
    Gap(StreamGap),
    /// The connection or samples are lost.
    Lost(StreamLoss),
    /// A lost connection is there again.
    ConnectedAgain(ConnectedAgain),
    /// A line of the stream is no message, and was left out.
    BadLine(BadLineFound),
    /// Something began too late to be judged.
    LeftOut(LeftOutLater),
    /// The recording has reached its limit and takes no further sample.
    RecordingFull(RecordingFull),
    /// The last line: the verdict of the run.
    Finished(Box<WatchEnd>),
}

/// What was found in a stream and is judged.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct WatchStart {
    /// Where the stream comes from.
    pub source: String,
    /// Name of the robot.
    pub robot: String,
    /// Name of the scenario.
    pub scenario: String,
    /// Joints that the stream has.
    pub joints: Vec<String>,
    /// Joints that it does not have: they stay at their start.
    pub held: Vec<String>,
    /// Rate of its joint states, Hz; `null` if it is not known.
    pub rate_hz: Option<f64>,
    /// Nothing is interpolated or differentiated across a longer time without samples.
    pub maximum_gap_s: f64,
    /// Poses that are compared with the model.
    pub poses: Vec<ComparedStream>,
    /// Checks of the run.
    pub checks: Vec<CheckKind>,
    /// What was taken and left out, and why.
    pub taken: Vec<String>,
}

/// Poses of a stream that are compared with the model.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct ComparedStream {
    /// Their name.
    pub name: String,
    /// Where they come from.
    pub origin: PoseOrigin,
}

/// The pose of the TCP at a sample, by the URDF at the joint positions of the stream.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct WatchedPose {
    /// Time of the sample.
    pub time_s: f64,
    /// The link in which the pose is given.
    pub frame: String,
    /// `tcp` if the robot file has a TCP, else the link at the end of the chain.
    pub child: String,
    /// Position of the TCP, m.
    pub translation_m: [f64; 3],
    /// Rotation from the TCP to the frame, scalar first.
    pub quaternion_wxyz: [f64; 4],
}

/// A value of a check that has left its limit, or came back.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct CheckChange {
    /// Time of the sample, or of the value if it was found later.
    pub time_s: f64,
    /// Kind of the check.
    pub check: CheckKind,
    /// Number of the check in the scenario, from 1.
    pub number: usize,
    /// Name of the quantity.
    #[schemars(with = "String")]
    pub quantity: Quantity,
    /// The value, in `unit`; `null` if it is infinite.
    #[schemars(with = "Option<f64>")]
    pub value: f64,
    /// The limit, in `unit`.
    pub limit: f64,
    /// Unit of value and limit; empty for a ratio.
    #[schemars(with = "String")]
    pub unit: SiUnit,
    /// On which side of the limit the value must be.
    pub bound: Bound,
    /// The joint, link or pair that has the value; `null` if it has no name.
    #[serde(rename = "where")]
    pub subject: Option<String>,
}

/// A time without samples.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct StreamGap {
    /// Time of the sample before.
    pub from_s: f64,
    /// Time of the sample behind it.
    pub to_s: f64,
    /// What it is.
    pub cause: GapCause,
}

/// What is between two samples that do not follow each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum GapCause {
    /// Nothing came.
    NoSamples,
    /// The clock of the sender went back: what follows is a new part.
    ClockWentBack,
}

/// Something of a stream is lost.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct StreamLoss {
    /// What is lost.
    pub what: LossCause,
    /// Why, in words.
    pub message: String,
    /// Samples that were not judged for it; 0 for a connection, of which nobody knows.
    pub samples: u64,
}

/// What is lost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LossCause {
    /// The connection; it is tried again.
    Connection,
    /// Samples: the checks are slower than the stream, and its sender does not wait.
    Samples,
}

/// A lost connection is there again.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct ConnectedAgain {
    /// How often it was tried.
    pub attempts: u32,
}

/// A line of the stream that is no message.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct BadLineFound {
    /// Its number, from 1.
    pub line: u64,
    /// What is wrong with it.
    pub message: String,
    /// How it begins.
    pub text: String,
}

/// Something that began too late to be judged.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct LeftOutLater {
    /// What it is, and why it is not judged.
    pub message: String,
}

/// A recording that has reached its limit.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct RecordingFull {
    /// The file.
    pub file: String,
    /// Time of the last sample in it.
    pub time_s: f64,
    /// The limit.
    pub limit_mb: u32,
}

/// The verdict on a stream.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct WatchEnd {
    /// The verdict.
    pub verdict: Verdict,
    /// Exit code of the call.
    pub exit_code: u8,
    /// What became of the messages.
    pub counts: StreamCounts,
    /// How long samples waited for their answer; `null` if none came while the run went on.
    pub latency: Option<LatencyReport>,
    /// The report of the run, as `run` and `replay` give it.
    pub report: RunReport,
}

/// What became of the messages of a stream.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub struct StreamCounts {
    /// Samples that were judged.
    pub samples: u64,
    /// Instants that were left out, since a joint was not known at them.
    pub left_out: u64,
    /// Messages with the time of the one before.
    pub repeated: u64,
    /// Messages that are earlier than one before them.
    pub late: u64,
    /// Messages without a position of any joint of the robot.
    pub without_positions: u64,
    /// Times without samples.
    pub gaps: u64,
    /// How often the clock of the sender went back.
    pub restarts: u64,
    /// Lines that are no messages.
    pub bad_lines: u64,
    /// Samples that were lost since the queue was full.
    pub lost_samples: u64,
    /// How often the connection was lost.
    pub lost_connections: u64,
}
