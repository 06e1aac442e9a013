//! The descriptions of robots that were met in a log.

use crate::event::LoggedDescription;

/// The last description of each topic, in the order in which they were recorded.
#[derive(Debug, Default)]
pub(crate) struct Descriptions(Vec<LastDescription>);

/// The last description of a topic.
#[derive(Debug)]
pub(crate) struct LastDescription {
    pub(crate) description: LoggedDescription,
    /// How often its text was another one than before.
    pub(crate) changes: u64,
}

impl Descriptions {
    pub(crate) fn take(&mut self, description: LoggedDescription) {
        let known = self.0.iter().position(|of| of.description.topic == description.topic);
        let changes = known.map_or(0, |at| {
            let before = self.0.remove(at);
            before.changes + u64::from(before.description.text != description.text)
        });
        self.0.push(LastDescription { description, changes });
    }

    pub(crate) fn all(&self) -> &[LastDescription] {
        &self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::event::EventTime;

    #[test]
    fn the_texts_of_two_topics_are_no_change() {
        let mut found = Descriptions::default();
        for (topic, text) in [(0, "a"), (1, "b"), (0, "a"), (1, "c")] {
            let time = EventTime::new(0, None, 0);
            found.take(LoggedDescription { topic, time, text: text.to_owned() });
        }
        let all: Vec<_> =
            found.all().iter().map(|of| (of.description.topic, &*of.description.text, of.changes)).collect();
        assert_eq!(all, [(0, "a", 0), (1, "c", 1)]);
    }
}
