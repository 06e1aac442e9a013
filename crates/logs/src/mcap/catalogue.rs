//! The topics of a log, and which channel of a file is which of them.

use std::{collections::BTreeMap, sync::Arc};

use mcap::records::{Channel, SchemaHeader};

use crate::{
    cdr::{CDR, MessageKind},
    event::{LogTopic, TopicContent},
};

/// What is known of a topic beyond its names.
#[derive(Debug, Clone)]
pub(super) struct TopicState {
    /// How its messages are decoded; `None` if they are not.
    pub(super) kind: Option<MessageKind>,
    /// The names of joints of the message before: most messages have the same.
    pub(super) joints: Option<Arc<[String]>>,
}

/// Topics of all files of a log, channels of the one that is being read.
#[derive(Default)]
pub(super) struct TopicCatalogue {
    pub(super) topics: Vec<LogTopic>,
    pub(super) states: Vec<TopicState>,
    types: BTreeMap<u16, String>,
    channels: BTreeMap<u16, usize>,
}

impl TopicCatalogue {
    /// Numbers of channels and schemas are those of one file.
    pub(super) fn begin_file(&mut self) {
        self.types.clear();
        self.channels.clear();
    }

    pub(super) fn add_schema(&mut self, schema: SchemaHeader) {
        self.types.insert(schema.id, schema.name);
    }

    pub(super) fn add_channel(&mut self, channel: &Channel) {
        // Channels are repeated in later chunks.
        if self.channels.contains_key(&channel.id) {
            return;
        }
        let known = self.types.get(&channel.schema_id).cloned();
        // 0 means that there is no schema. Another one that is not known was in a damaged part: the summary may have it.
        let Some(message_type) = known.or_else(|| (channel.schema_id == 0).then(String::new)) else { return };
        let is_same = |topic: &LogTopic| {
            (&topic.name, &topic.message_type, &topic.encoding)
                == (&channel.topic, &message_type, &channel.message_encoding)
        };
        let index = self.topics.iter().position(is_same).unwrap_or_else(|| {
            self.add_topic(channel.topic.clone(), message_type.clone(), channel.message_encoding.clone())
        });
        self.channels.insert(channel.id, index);
    }

    fn add_topic(&mut self, name: String, message_type: String, encoding: String) -> usize {
        let kind = MessageKind::of_type(&message_type).filter(|_| encoding == CDR);
        let content = kind.map_or(TopicContent::TimesAlone, |kind| content(kind, &name));
        // Other texts are log messages and states of machines.
        let kind = kind.filter(|_| content != TopicContent::TimesAlone);
        self.topics.push(LogTopic { name, message_type, encoding, content });
        self.states.push(TopicState { kind, joints: None });
        self.topics.len() - 1
    }

    /// The topic of a channel.
    pub(super) fn topic(&self, channel: u16) -> Option<usize> {
        self.channels.get(&channel).copied()
    }
}

fn content(kind: MessageKind, topic: &str) -> TopicContent {
    let name = topic.rsplit('/').next().unwrap_or(topic);
    match kind {
        MessageKind::JointState => TopicContent::Joints,
        MessageKind::Pose => TopicContent::Pose,
        MessageKind::Transforms if name == "tf_static" => TopicContent::StaticTransforms,
        MessageKind::Transform | MessageKind::Transforms => TopicContent::Transforms,
        MessageKind::Text if name == "robot_description" => TopicContent::Description,
        MessageKind::Text => TopicContent::TimesAlone,
    }
}
