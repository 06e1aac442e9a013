//! The messages of a stream of lines, one after another.

use std::{
    io::{self, BufRead},
    sync::Arc,
};

use super::{
    bounded_line::{LineLength, read_line},
    line::{Line, LineJoints, LineOrigin, LinePose},
};
use crate::event::{EventTime, LogTopic, LoggedJoints, LoggedPose, TopicContent};

/// The topic of joint states.
const JOINTS: &str = "joints";
/// The type and the encoding of all topics.
const TYPE: &str = "line";
const ENCODING: &str = "json";
/// Most characters of a line that is shown.
const MOST_SHOWN: usize = 120;

/// A line that is no message.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct BadLine {
    /// Its number, from 1.
    pub(crate) line: u64,
    /// What is wrong with it.
    pub(crate) message: String,
    /// How it begins.
    pub(crate) text: String,
}

/// What one line gives.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct LineEvents {
    pub(crate) joints: Option<LoggedJoints>,
    pub(crate) pose: Option<LoggedPose>,
}

/// A stream of lines.
pub(crate) struct JsonLines<R> {
    input: R,
    buffer: Vec<u8>,
    line: u64,
    /// Names of the last joints: messages with the same names share them.
    names: Arc<[String]>,
    topics: Vec<LogTopic>,
    first_ns: Option<i64>,
}

impl<R: BufRead> JsonLines<R> {
    pub(crate) fn new(input: R) -> Self {
        Self { input, buffer: Vec::new(), line: 0, names: Arc::default(), topics: Vec::new(), first_ns: None }
    }

    /// The topics of the lines so far.
    pub(crate) fn topics(&self) -> &[LogTopic] {
        &self.topics
    }

    /// Number of lines that were read.
    pub(crate) fn lines(&self) -> u64 {
        self.line
    }

    /// The next line that is not empty; `None` at the end. `arrival` gives the time at which the recorder has a line that its sender
    /// says was true at a time: that time itself in a file.
    ///
    /// # Errors
    /// The stream cannot be read.
    pub(crate) fn next(
        &mut self,
        arrival: impl FnOnce(i64) -> i64,
    ) -> io::Result<Option<Result<LineEvents, BadLine>>> {
        loop {
            let length = read_line(&mut self.input, &mut self.buffer)?;
            if length == LineLength::End {
                return Ok(None);
            }
            self.line += 1;
            if length == LineLength::TooLong {
                return Ok(Some(Err(self.bad("it is longer than 128 KiB".to_owned()))));
            }
            if self.buffer.trim_ascii().is_empty() {
                continue;
            }
            return Ok(Some(match Line::parse(&self.buffer) {
                Ok(line) => Ok(self.events(line, arrival)),
                Err(message) => Err(self.bad(message)),
            }));
        }
    }

    fn bad(&self, message: String) -> BadLine {
        let text = String::from_utf8_lossy(&self.buffer).chars().take(MOST_SHOWN).collect();
        BadLine { line: self.line, message, text }
    }

    fn events(&mut self, line: Line, arrival: impl FnOnce(i64) -> i64) -> LineEvents {
        let Line { time_ns, joints, pose } = line;
        let log_ns = arrival(time_ns);
        let first_ns = *self.first_ns.get_or_insert(log_ns);
        let time = EventTime::new(log_ns, Some(time_ns), first_ns);
        LineEvents {
            joints: joints.map(|joints| self.joints(joints, time)),
            pose: pose.map(|pose| self.pose(pose, time)),
        }
    }

    fn joints(&mut self, joints: LineJoints, time: EventTime) -> LoggedJoints {
        let LineJoints { names, position, velocity, effort } = joints;
        if *self.names != *names {
            self.names = names.into();
        }
        let topic = self.topic(JOINTS, TopicContent::Joints);
        LoggedJoints { topic, time, names: Arc::clone(&self.names), position, velocity, effort }
    }

    fn pose(&mut self, pose: LinePose, time: EventTime) -> LoggedPose {
        // Poses of different origins are different topics: they are never mixed.
        let name = match pose.origin {
            Some(LineOrigin::Derived) => "derived",
            Some(LineOrigin::Controller) => "controller",
            Some(LineOrigin::Measured) => "measured",
            None => "pose",
        };
        LoggedPose {
            topic: self.topic(name, TopicContent::Pose),
            time,
            is_first_of_message: true,
            frame: pose.frame,
            child: pose.child,
            child_in_frame_m: pose.translation_m,
            frame_from_child_wxyz: pose.quaternion_wxyz,
        }
    }

    fn topic(&mut self, name: &str, content: TopicContent) -> usize {
        if let Some(at) = self.topics.iter().position(|topic| topic.name == name) {
            return at;
        }
        let (message_type, encoding) = (TYPE.to_owned(), ENCODING.to_owned());
        self.topics.push(LogTopic { name: name.to_owned(), message_type, encoding, content });
        self.topics.len() - 1
    }
}
