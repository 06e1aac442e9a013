//! A log in MCAP that programs for ROS 2 read: joint states, TF, the description of the robot, and diagnostics.

mod schemas;

use std::{collections::BTreeMap, fs::File, io::BufWriter, path::Path};

use mcap::{WriteOptions, Writer, records::MessageHeader};
use nalgebra::Isometry3;

use self::schemas::{DIAGNOSTICS, JOINT_STATE, Schema, TEXT, TRANSFORMS};
use crate::cdr::{CDR, CdrText, joint_state_text};

/// Bytes of a chunk: a program that is killed loses the last one. Kind: choice.
const CHUNK_BYTES: u64 = 256 << 10;
/// What `ros2 bag play` offers of a topic that is published once: nodes that come later get it as well.
/// All keys of a profile: readers have defaults for none of them.
const LATCHED: &str = "- history: 1\n  depth: 1\n  reliability: 1\n  durability: 1\n  deadline:\n    sec: 0\n    nsec: 0\n  \
    lifespan:\n    sec: 0\n    nsec: 0\n  liveliness: 1\n  liveliness_lease_duration:\n    sec: 0\n    nsec: 0\n  \
    avoid_ros_namespace_conventions: false\n";
/// The time of the first message: to ROS a stamp of 0 is none.
const BEGIN_NS: i64 = 1_000_000_000;

/// A topic of joint states.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointTopic {
    /// `/joint_states`: what the sensors say.
    Measured,
    /// `/joint_states_desired`: what the joints are commanded to do.
    Desired,
}

/// Joint states of one instant; an array is empty if it is not known.
#[derive(Debug, Clone, Copy)]
pub struct WrittenJoints<'a> {
    /// Names of the joints, in the order of the arrays.
    pub names: &'a [String],
    /// Positions, rad or m.
    pub position: &'a [f64],
    /// Velocities, rad/s or m/s.
    pub velocity: &'a [f64],
    /// Efforts, N m or N.
    pub effort: &'a [f64],
}

/// An edge of TF.
#[derive(Debug, Clone, Copy)]
pub struct WrittenEdge<'a> {
    /// The frame in which the pose is given.
    pub frame: &'a str,
    /// The frame whose pose it is.
    pub child: &'a str,
    /// The pose.
    pub frame_from_child: Isometry3<f64>,
}

/// How something is, by `diagnostic_msgs`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DiagnosticLevel {
    /// As it should be.
    Ok = 0,
    /// Not known, or not quite.
    Warn = 1,
    /// Not as it should be.
    Error = 2,
}

/// The state of one thing that is watched.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WrittenDiagnostic {
    /// How it is.
    pub level: DiagnosticLevel,
    /// What it is.
    pub name: String,
    /// In one line.
    pub message: String,
    /// The robot.
    pub hardware_id: String,
    /// Values with their names.
    pub values: Vec<(String, String)>,
}

/// Why a log cannot be written.
#[derive(Debug, thiserror::Error)]
#[error(transparent)]
pub struct LogWriteError(#[from] mcap::McapError);

/// Writes a log message by message, in the order of time. Times are from the beginning on, s; the log begins at 1 s since 1970, as a
/// clock of simulation does, since a stamp of 0 means that there is none.
///
/// # Examples
/// ```
/// use congruent_logs::{JointTopic, LogOptions, LogWriter, WrittenJoints, survey_log};
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("run.mcap");
/// let mut log = LogWriter::create(&path)?;
/// let names = ["elbow".to_owned()];
/// let joints = WrittenJoints { names: &names, position: &[0.5], velocity: &[], effort: &[] };
/// log.joint_states(JointTopic::Measured, 0.0, &joints)?;
/// log.finish()?;
/// assert_eq!(survey_log(&path, &LogOptions::default(), None).unwrap().survey.messages, 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct LogWriter {
    file: Writer<BufWriter<File>>,
    /// Number of each topic with a message, by its name.
    channels: BTreeMap<&'static str, u16>,
    /// The message that is being written.
    text: CdrText,
}

impl std::fmt::Debug for LogWriter {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("LogWriter").field("topics", &self.channels).finish_non_exhaustive()
    }
}

impl LogWriter {
    /// An empty log.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn create(path: &Path) -> Result<Self, LogWriteError> {
        let file = File::create(path).map_err(mcap::McapError::from)?;
        let options = WriteOptions::new()
            .compression(None)
            .profile("ros2")
            .library(concat!("congruent ", env!("CARGO_PKG_VERSION")))
            .chunk_size(Some(CHUNK_BYTES));
        let file = options.create(BufWriter::new(file))?;
        Ok(Self { file, channels: BTreeMap::new(), text: CdrText::default() })
    }

    /// Writes the description of the robot, a URDF.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn description(&mut self, urdf: &str) -> Result<(), LogWriteError> {
        self.text.begin();
        self.text.text(urdf);
        self.write("/robot_description", &TEXT, LATCHED, BEGIN_NS)
    }

    /// Writes the edges of TF that do not change.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn static_transforms<'e>(
        &mut self,
        edges: impl ExactSizeIterator<Item = WrittenEdge<'e>>,
    ) -> Result<(), LogWriteError> {
        self.edges(edges, BEGIN_NS);
        self.write("/tf_static", &TRANSFORMS, LATCHED, BEGIN_NS)
    }

    /// Writes edges of TF as they are at this time.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn transforms<'e>(
        &mut self,
        time_s: f64,
        edges: impl ExactSizeIterator<Item = WrittenEdge<'e>>,
    ) -> Result<(), LogWriteError> {
        let ns = nanoseconds(time_s);
        self.edges(edges, ns);
        self.write("/tf", &TRANSFORMS, "", ns)
    }

    /// Writes joint states.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn joint_states(
        &mut self,
        topic: JointTopic,
        time_s: f64,
        joints: &WrittenJoints<'_>,
    ) -> Result<(), LogWriteError> {
        let ns = nanoseconds(time_s);
        self.text.begin();
        joint_state_text(&mut self.text, ns, joints.names.iter().map(String::as_str));
        for array in [joints.position, joints.velocity, joints.effort] {
            self.text.f64_list(array);
        }
        let topic = match topic {
            JointTopic::Measured => "/joint_states",
            JointTopic::Desired => "/joint_states_desired",
        };
        self.write(topic, &JOINT_STATE, "", ns)
    }

    /// Writes how things are at this time.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn diagnostics(&mut self, time_s: f64, all: &[WrittenDiagnostic]) -> Result<(), LogWriteError> {
        let ns = nanoseconds(time_s);
        self.text.begin();
        self.text.header(ns, "");
        self.text.count(all.len());
        for WrittenDiagnostic { level, name, message, hardware_id, values } in all {
            self.text.byte(*level as u8);
            for text in [name, message, hardware_id] {
                self.text.text(text);
            }
            self.text.count(values.len());
            for (key, value) in values {
                self.text.text(key);
                self.text.text(value);
            }
        }
        self.write("/diagnostics", &DIAGNOSTICS, "", ns)
    }

    /// Writes the end of the file.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn finish(mut self) -> Result<(), LogWriteError> {
        self.file.finish()?;
        let rest = self.file.into_inner().into_inner();
        Ok(rest.map(drop).map_err(|error| mcap::McapError::from(error.into_error()))?)
    }

    fn edges<'e>(&mut self, edges: impl ExactSizeIterator<Item = WrittenEdge<'e>>, ns: i64) {
        self.text.begin();
        self.text.count(edges.len());
        for WrittenEdge { frame, child, frame_from_child } in edges {
            self.text.header(ns, frame);
            self.text.text(child);
            let rotation = frame_from_child.rotation.coords;
            let translation = frame_from_child.translation.vector;
            for value in translation.iter().chain(&rotation) {
                self.text.f64(*value);
            }
        }
    }

    /// Writes the text as a message of a topic, which is declared with its first one.
    fn write(
        &mut self,
        topic: &'static str,
        schema: &Schema,
        qos: &str,
        ns: i64,
    ) -> Result<(), LogWriteError> {
        let channel_id = if let Some(&channel) = self.channels.get(topic) {
            channel
        } else {
            let schema = self.file.add_schema(schema.name, "ros2msg", schema.text().as_bytes())?;
            let qos = (!qos.is_empty()).then(|| ("offered_qos_profiles".to_owned(), qos.to_owned()));
            let channel = self.file.add_channel(schema, topic, CDR, &qos.into_iter().collect())?;
            self.channels.insert(topic, channel);
            channel
        };
        let log_time = ns.unsigned_abs();
        let header = MessageHeader { channel_id, sequence: 0, log_time, publish_time: log_time };
        Ok(self.file.write_to_known_channel(&header, &self.text.bytes)?)
    }
}

/// A time from the beginning on, on the clock of the log.
#[expect(clippy::cast_possible_truncation, reason = "the cast of floats saturates")]
fn nanoseconds(time_s: f64) -> i64 {
    BEGIN_NS.saturating_add((time_s * 1e9).round() as i64)
}

#[cfg(test)]
mod tests;
