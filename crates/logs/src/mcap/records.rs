//! Records of a file to messages of topics.

use std::collections::BTreeSet;

use congruent_input::Diagnostic;
use mcap::{
    parse_record,
    records::{MessageHeader, Record, op},
};

use super::{channels::Channels, summary::Summary};
use crate::messages::MessageEvents;

/// Why a record gives no event.
pub(super) enum RecordFault {
    /// It is damaged; the next may be whole.
    Damaged(String),
    /// No record of its kind can be read.
    Refused(Diagnostic),
}

/// What the records of a log have given.
#[derive(Default)]
pub(super) struct Records {
    pub(super) events: MessageEvents,
    channels: Channels,
    /// Channels of the file that no record declares, or not their types, each reported once.
    undeclared: BTreeSet<u16>,
}

impl Records {
    /// `refused` is why files of the log are not read.
    pub(super) fn new(refused: Vec<Diagnostic>) -> Self {
        Self { events: MessageEvents::with_gaps(refused), ..Self::default() }
    }

    /// Numbers of channels and schemas are those of one file.
    pub(super) fn begin_file(&mut self) {
        self.channels = Channels::default();
        self.undeclared.clear();
    }

    /// A part without messages, with the log times of its first and last one.
    pub(super) fn gap(&mut self, times_ns: Option<[u64; 2]>, cause: Diagnostic) {
        self.events.gap(times_ns.map(|times_ns| times_ns.map(signed)), cause);
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
            Record::Schema { header, .. } => self.channels.add_schema(header),
            Record::Channel(channel) => self.channels.add_channel(&channel, &mut self.events),
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
        self.events.take(topic, signed(header.log_time), data).map_err(RecordFault::Refused)
    }

    /// The topic of a channel; if the chunk that declares it was damaged, by the summary.
    fn topic(&mut self, channel: u16, summary: &Summary) -> Option<usize> {
        if self.channels.topic(channel).is_none() && !self.undeclared.contains(&channel) {
            summary.schemas.iter().for_each(|schema| self.channels.add_schema(schema.clone()));
            for channel in &summary.channels {
                self.channels.add_channel(channel, &mut self.events);
            }
        }
        self.channels.topic(channel)
    }
}

/// Nanoseconds since 1970 fit until the year 2262.
fn signed(ns: u64) -> i64 {
    i64::try_from(ns).unwrap_or(i64::MAX)
}
