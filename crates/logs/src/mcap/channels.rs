//! Which channel of a file is which topic of the log.

use std::collections::BTreeMap;

use mcap::records::{Channel, SchemaHeader};

use crate::messages::MessageEvents;

/// Schemas and channels of the file that is being read.
#[derive(Default)]
pub(super) struct Channels {
    types: BTreeMap<u16, String>,
    topics: BTreeMap<u16, usize>,
}

impl Channels {
    pub(super) fn add_schema(&mut self, schema: SchemaHeader) {
        self.types.insert(schema.id, schema.name);
    }

    pub(super) fn add_channel(&mut self, channel: &Channel, events: &mut MessageEvents) {
        // Channels are repeated in later chunks.
        if self.topics.contains_key(&channel.id) {
            return;
        }
        // 0 means that there is no schema. Another one that is not known was in a damaged part: the summary may have it.
        let without = (channel.schema_id == 0).then_some("");
        let known = self.types.get(&channel.schema_id).map(String::as_str);
        let Some(message_type) = known.or(without) else { return };
        let topic = events.topic(&channel.topic, message_type, &channel.message_encoding);
        self.topics.insert(channel.id, topic);
    }

    /// The topic of a channel.
    pub(super) fn topic(&self, channel: u16) -> Option<usize> {
        self.topics.get(&channel).copied()
    }
}
