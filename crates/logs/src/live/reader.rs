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
use crate::event::{LogEvent, LogFormat, LogReader, LogTopic, seconds};

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
    /// Samples in a second of a sender that does not wait; `None` of one that does.
    sent_hz: Option<f64>,
    /// When the last message came, by `clock`.
    last_ns: Option<i64>,
    /// Whether the connection is lost, and not there again.
    is_lost: bool,
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
            sent_hz: None,
            last_ns: None,
            is_lost: false,
        }
    }

    /// The sender does not wait: what it had while the connection was lost is gone.
    pub(crate) fn sent_at(self, rate_hz: f64) -> Self {
        Self { sent_hz: Some(rate_hz), ..self }
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

    /// Says what has happened; an event if messages cannot be judged for it.
    fn take_notice(&mut self, notice: LiveNotice) -> Option<LogEvent> {
        let unusable = match &notice {
            LiveNotice::BadLine { .. } => 1,
            LiveNotice::SamplesLost { samples } => *samples,
            LiveNotice::ConnectedAgain { .. } => self.missed(),
            LiveNotice::ConnectionLost { .. } | LiveNotice::LateTopic { .. } => 0,
        };
        match &notice {
            LiveNotice::ConnectionLost { .. } => self.is_lost = true,
            LiveNotice::ConnectedAgain { .. } => self.is_lost = false,
            _ => {}
        }
        (self.on_notice)(notice);
        (unusable > 0).then_some(LogEvent::Unusable(unusable))
    }

    /// Samples that the sender has had since its last one came.
    fn missed(&self) -> u64 {
        let (Some(rate_hz), Some(last_ns)) = (self.sent_hz, self.last_ns) else { return 0 };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count, not negative")]
        let missed = (seconds(self.clock.now_ns().saturating_sub(last_ns)).max(0.0) * rate_hz) as u64;
        missed
    }

    /// The stream has ended: without its connection, samples until now are missing.
    fn end(&mut self) -> Option<LogEvent> {
        let missed = if self.is_lost { self.missed() } else { 0 };
        self.is_lost = false;
        (missed > 0).then_some(LogEvent::Unusable(missed))
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
                return Ok(self.end());
            }
            match self.queue.recv_timeout(PERIOD) {
                Ok(Arrived::Event(event)) => {
                    if let LogEvent::Joints(joints) = &event {
                        self.last_ns = Some(joints.time.log_ns);
                    }
                    return Ok(Some(event));
                }
                Ok(Arrived::Topic(topic)) => self.take_topic(topic),
                Ok(Arrived::Notice(notice)) => {
                    if let Some(event) = self.take_notice(notice) {
                        return Ok(Some(event));
                    }
                }
                Ok(Arrived::Failed(why)) => return Err(why),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return Ok(self.end()),
            }
        }
    }
}
