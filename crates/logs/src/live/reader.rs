//! A stream as a log that has no end yet.

use std::{
    collections::VecDeque,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
        mpsc::{Receiver, RecvTimeoutError},
    },
    time::Duration,
};

use congruent_input::Diagnostic;

use super::{
    arrival::ArrivalClock,
    notice::LiveNotice,
    queue::{Arrived, LiveQueue},
};
use crate::event::{LogEvent, LogFormat, LogReader, LogTopic};

/// How often a stream that is silent is asked whether it has to end.
const PERIOD: Duration = Duration::from_millis(20);

/// Who hears what happens to a stream.
pub type OnNotice = Box<dyn FnMut(LiveNotice)>;

/// A stream that another thread reads.
pub struct LiveReader {
    queue: Receiver<Arrived>,
    format: LogFormat,
    topics: Vec<LogTopic>,
    /// Events that were looked at already, and are given once more.
    heard: VecDeque<LogEvent>,
    /// Whether it was found out what the stream has: topics that come later are not judged.
    is_surveyed: bool,
    stop: Arc<AtomicBool>,
    clock: ArrivalClock,
    on_notice: OnNotice,
}

impl std::fmt::Debug for LiveReader {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("LiveReader").field("format", &self.format).finish_non_exhaustive()
    }
}

impl LiveReader {
    /// Begins to read, by `read` on a thread of its own. The stream ends when `read` returns, or when `stop` is set; a thread that waits
    /// for input then stays behind until the program ends.
    pub(crate) fn start(
        format: LogFormat,
        stop: Arc<AtomicBool>,
        on_notice: OnNotice,
        read: impl FnOnce(LiveQueue) + Send + 'static,
    ) -> Self {
        let (sender, queue) = LiveQueue::new(Arc::clone(&stop));
        let clock = sender.clock.clone();
        std::thread::spawn(move || read(sender));
        Self {
            queue,
            format,
            topics: Vec::new(),
            heard: VecDeque::new(),
            is_surveyed: false,
            stop,
            clock,
            on_notice,
        }
    }

    /// The clock by which messages come.
    pub fn clock(&self) -> &ArrivalClock {
        &self.clock
    }

    /// Gives events once more, before those that follow.
    pub(super) fn give_again(&mut self, events: Vec<LogEvent>) {
        self.heard.extend(events);
        self.is_surveyed = true;
    }

    fn take_topic(&mut self, topic: LogTopic) {
        if self.is_surveyed {
            (self.on_notice)(LiveNotice::LateTopic { topic: topic.name.clone() });
        }
        self.topics.push(topic);
    }
}

impl LogReader for LiveReader {
    fn topics(&self) -> &[LogTopic] {
        &self.topics
    }

    fn format(&self) -> LogFormat {
        self.format
    }

    fn next_event(&mut self) -> Result<Option<LogEvent>, Diagnostic> {
        if let Some(event) = self.heard.pop_front() {
            return Ok(Some(event));
        }
        loop {
            if self.stop.load(Ordering::Relaxed) {
                return Ok(None);
            }
            match self.queue.recv_timeout(PERIOD) {
                Ok(Arrived::Event(event)) => return Ok(Some(event)),
                Ok(Arrived::Topic(topic)) => self.take_topic(topic),
                Ok(Arrived::Notice(notice)) => (self.on_notice)(notice),
                Ok(Arrived::Failed(why)) => return Err(why),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return Ok(None),
            }
        }
    }
}
