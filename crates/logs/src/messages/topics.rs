//! The topics of a log, and how the messages of each are decoded.

use std::sync::Arc;

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

/// Topics of all files of a log. An index stays valid.
#[derive(Default)]
pub(super) struct Topics {
    pub(super) all: Vec<LogTopic>,
    pub(super) states: Vec<TopicState>,
}

impl Topics {
    /// The index of a topic with this name, type and encoding, which is added if it is new.
    pub(super) fn index(&mut self, name: &str, message_type: &str, encoding: &str) -> usize {
        let is_same = |topic: &LogTopic| {
            (topic.name.as_str(), topic.message_type.as_str(), topic.encoding.as_str())
                == (name, message_type, encoding)
        };
        self.all.iter().position(is_same).unwrap_or_else(|| self.add(name, message_type, encoding))
    }

    fn add(&mut self, name: &str, message_type: &str, encoding: &str) -> usize {
        let kind = MessageKind::of_type(message_type).filter(|_| encoding == CDR);
        let content = kind.map_or(TopicContent::TimesAlone, |kind| content(kind, name));
        // Other texts are log messages and states of machines.
        let kind = kind.filter(|_| content != TopicContent::TimesAlone);
        let [name, message_type, encoding] = [name, message_type, encoding].map(str::to_owned);
        self.all.push(LogTopic { name, message_type, encoding, content });
        self.states.push(TopicState { kind, joints: None });
        self.all.len() - 1
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
