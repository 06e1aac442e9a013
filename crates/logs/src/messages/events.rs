//! Each message of a log to the events that it gives.

use std::{collections::VecDeque, sync::Arc};

use congruent_input::{Diagnostic, Severity};

use super::topics::Topics;
use crate::{
    cdr::{CdrFault, Decoded, DecodedPose},
    codes,
    event::{
        EventTime, LogEvent, LogGap, LogTopic, LoggedDescription, LoggedJoints, LoggedPose, OtherMessage,
        TopicContent,
    },
    options::CONVERT,
};

/// The topics that were met, and the events that were not fetched yet.
#[derive(Default)]
pub(crate) struct MessageEvents {
    topics: Topics,
    waiting: VecDeque<LogEvent>,
    /// Log time of the first message of the log.
    first_ns: Option<i64>,
}

impl MessageEvents {
    /// Begins with these gaps: files of the log that are not read.
    pub(crate) fn with_gaps(causes: Vec<Diagnostic>) -> Self {
        let mut events = Self::default();
        for cause in causes {
            events.gap(None, Diagnostic { severity: Severity::Warning, ..cause });
        }
        events
    }

    pub(crate) fn topics(&self) -> &[LogTopic] {
        &self.topics.all
    }

    /// The index of a topic, which is the same in all files of a log.
    pub(crate) fn topic(&mut self, name: &str, message_type: &str, encoding: &str) -> usize {
        self.topics.index(name, message_type, encoding)
    }

    /// Whether more than the times of a topic is read.
    #[cfg(feature = "db3")]
    pub(crate) fn is_decoded(&self, topic: usize) -> bool {
        self.topics.states[topic].kind.is_some()
    }

    /// The next event that waits.
    pub(crate) fn next(&mut self) -> Option<LogEvent> {
        self.waiting.pop_front()
    }

    /// A part without messages, with the log times of its first and last one.
    pub(crate) fn gap(&mut self, times_ns: Option<[i64; 2]>, cause: Diagnostic) {
        let since_first = |ns| EventTime::new(ns, None, self.first_ns.unwrap_or(ns)).log_s;
        let between_s = times_ns.map(|times_ns| times_ns.map(since_first));
        self.waiting.push_back(LogEvent::Gap(LogGap { between_s, cause }));
    }

    /// Takes a message of a topic.
    ///
    /// # Errors
    /// Messages of the log are compressed one by one: none of them can be read.
    pub(crate) fn take(&mut self, topic: usize, log_ns: i64, data: &[u8]) -> Result<(), Diagnostic> {
        let first_ns = *self.first_ns.get_or_insert(log_ns);
        let time = |stamp_ns| EventTime::new(log_ns, stamp_ns, first_ns);
        let other = |fault| LogEvent::Other(OtherMessage { topic, time: time(None), fault });
        let Some(kind) = self.topics.states[topic].kind else {
            self.waiting.push_back(other(None));
            return Ok(());
        };
        match kind.decode(data) {
            Ok(Decoded::Joints { stamp_ns, names, position, velocity, effort }) => {
                let names = self.names(topic, &names);
                let time = time(stamp_ns);
                let joints = LoggedJoints { topic, time, names, position, velocity, effort };
                self.waiting.push_back(LogEvent::Joints(joints));
            }
            Ok(Decoded::Poses(poses)) if poses.is_empty() => self.waiting.push_back(other(None)),
            Ok(Decoded::Poses(poses)) => {
                let is_static = self.topics.all[topic].content == TopicContent::StaticTransforms;
                for (at, pose) in poses.into_iter().enumerate() {
                    let time = time(pose.stamp_ns);
                    let pose = LoggedPose { topic, is_first_of_message: at == 0, ..logged(&pose, time) };
                    let event = if is_static { LogEvent::StaticEdge(pose) } else { LogEvent::Pose(pose) };
                    self.waiting.push_back(event);
                }
            }
            Ok(Decoded::Text(text)) => {
                let description = LoggedDescription { topic, time: time(None), text: text.to_owned() };
                self.waiting.push_back(LogEvent::Description(description));
            }
            Err(CdrFault::Compressed) => return Err(self.compressed(topic)),
            Err(fault) => self.waiting.push_back(other(Some(fault.to_string()))),
        }
        Ok(())
    }

    /// The names as those of the message before, if they are the same.
    fn names(&mut self, topic: usize, names: &[&str]) -> Arc<[String]> {
        let known = &mut self.topics.states[topic].joints;
        if let Some(known) = known.as_ref().filter(|known| known.iter().eq(names)) {
            return Arc::clone(known);
        }
        let names: Arc<[String]> = names.iter().map(|&name| name.to_owned()).collect();
        *known = Some(Arc::clone(&names));
        names
    }

    fn compressed(&self, topic: usize) -> Diagnostic {
        let message = format!("each message of {} is compressed on its own", self.topics.all[topic].name);
        Diagnostic::error(codes::log::COMPRESSED_MESSAGES, message).with_help(CONVERT)
    }
}

fn logged(pose: &DecodedPose<'_>, time: EventTime) -> LoggedPose {
    LoggedPose {
        topic: 0,
        time,
        is_first_of_message: true,
        frame: pose.frame.to_owned(),
        child: pose.child.map(str::to_owned),
        child_in_frame_m: pose.child_in_frame_m,
        frame_from_child_wxyz: pose.frame_from_child_wxyz,
    }
}
