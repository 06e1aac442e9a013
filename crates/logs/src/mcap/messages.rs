//! Records of a file to events.

use std::{
    collections::{BTreeSet, VecDeque},
    sync::Arc,
};

use congruent_input::Diagnostic;
use mcap::{
    parse_record,
    records::{MessageHeader, Record, op},
};

use super::{catalogue::TopicCatalogue, summary::Summary};
use crate::{
    cdr::{CdrFault, Decoded, DecodedPose},
    codes,
    event::{EventTime, LogEvent, LoggedDescription, LoggedJoints, LoggedPose, OtherMessage, TopicContent},
    options::CONVERT,
};

/// Why a record gives no event.
pub(super) enum RecordFault {
    /// It is damaged; the next may be whole.
    Damaged(String),
    /// No record of its kind can be read.
    Refused(Diagnostic),
}

/// What has been read, and the events that were not fetched yet.
#[derive(Default)]
pub(super) struct Messages {
    pub(super) catalogue: TopicCatalogue,
    pub(super) events: VecDeque<LogEvent>,
    /// Log time of the first message of the log.
    first_ns: Option<i64>,
    /// Channels of the file that no record declares, or not their types, each reported once.
    undeclared: BTreeSet<u16>,
}

impl Messages {
    pub(super) fn begin_file(&mut self) {
        self.catalogue.begin_file();
        self.undeclared.clear();
    }

    /// Seconds from the first message on.
    pub(super) fn since_first(&self, log_ns: u64) -> f64 {
        let log_ns = signed(log_ns);
        EventTime::new(log_ns, None, self.first_ns.unwrap_or(log_ns)).log_s
    }

    /// Takes a record of a file or of a chunk; those of other kinds are passed over.
    pub(super) fn take(&mut self, code: u8, content: &[u8], summary: &Summary) -> Result<(), RecordFault> {
        // Other records are not parsed: the parser believes the lengths that an attachment claims.
        if ![op::SCHEMA, op::CHANNEL, op::MESSAGE].contains(&code) {
            return Ok(());
        }
        let record = parse_record(code, content);
        match record
            .map_err(|fault| RecordFault::Damaged(format!("a record in it cannot be read: {fault}")))?
        {
            Record::Schema { header, .. } => self.catalogue.add_schema(header),
            Record::Channel(channel) => self.catalogue.add_channel(&channel),
            Record::Message { header, data } => self.message(&header, &data, summary)?,
            _ => {}
        }
        Ok(())
    }

    fn message(&mut self, header: &MessageHeader, data: &[u8], summary: &Summary) -> Result<(), RecordFault> {
        let Some(topic) = self.topic(header.channel_id, summary) else {
            let is_new = self.undeclared.insert(header.channel_id);
            let message = format!(
                "messages of channel {} are left out: what declares it or its type is not in the log",
                header.channel_id
            );
            return if is_new { Err(RecordFault::Damaged(message)) } else { Ok(()) };
        };
        let log_ns = signed(header.log_time);
        let first_ns = *self.first_ns.get_or_insert(log_ns);
        let time = |stamp_ns| EventTime::new(log_ns, stamp_ns, first_ns);
        let other = |fault| LogEvent::Other(OtherMessage { topic, time: time(None), fault });
        let Some(kind) = self.catalogue.states[topic].kind else {
            self.events.push_back(other(None));
            return Ok(());
        };
        match kind.decode(data) {
            Ok(Decoded::Joints { stamp_ns, names, position, velocity, effort }) => {
                let names = self.names(topic, &names);
                let time = time(stamp_ns);
                let joints = LoggedJoints { topic, time, names, position, velocity, effort };
                self.events.push_back(LogEvent::Joints(joints));
            }
            Ok(Decoded::Poses(poses)) if poses.is_empty() => self.events.push_back(other(None)),
            Ok(Decoded::Poses(poses)) => {
                let is_static = self.catalogue.topics[topic].content == TopicContent::StaticTransforms;
                for (at, pose) in poses.into_iter().enumerate() {
                    let time = time(pose.stamp_ns);
                    let pose = LoggedPose { topic, is_first_of_message: at == 0, ..logged(&pose, time) };
                    let event = if is_static { LogEvent::StaticEdge(pose) } else { LogEvent::Pose(pose) };
                    self.events.push_back(event);
                }
            }
            Ok(Decoded::Text(text)) => {
                let description = LoggedDescription { topic, time: time(None), text: text.to_owned() };
                self.events.push_back(LogEvent::Description(description));
            }
            Err(CdrFault::Compressed) => return Err(RecordFault::Refused(self.compressed(topic))),
            Err(fault) => self.events.push_back(other(Some(fault.to_string()))),
        }
        Ok(())
    }

    /// The topic of a channel; if the chunk that declares it was damaged, by the summary.
    fn topic(&mut self, channel: u16, summary: &Summary) -> Option<usize> {
        if self.catalogue.topic(channel).is_none() && !self.undeclared.contains(&channel) {
            summary.schemas.iter().for_each(|schema| self.catalogue.add_schema(schema.clone()));
            summary.channels.iter().for_each(|channel| self.catalogue.add_channel(channel));
        }
        self.catalogue.topic(channel)
    }

    /// The names as those of the message before, if they are the same.
    fn names(&mut self, topic: usize, names: &[&str]) -> Arc<[String]> {
        let known = &mut self.catalogue.states[topic].joints;
        if let Some(known) = known.as_ref().filter(|known| known.iter().eq(names)) {
            return Arc::clone(known);
        }
        let names: Arc<[String]> = names.iter().map(|&name| name.to_owned()).collect();
        *known = Some(Arc::clone(&names));
        names
    }

    fn compressed(&self, topic: usize) -> Diagnostic {
        let message =
            format!("each message of {} is compressed on its own", self.catalogue.topics[topic].name);
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

/// Nanoseconds since 1970 fit until the year 2262.
fn signed(ns: u64) -> i64 {
    i64::try_from(ns).unwrap_or(i64::MAX)
}
