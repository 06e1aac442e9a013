//! The queue between the thread that reads a stream and the run that judges it.

use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
    mpsc::{Receiver, SyncSender, TrySendError, sync_channel},
};

use congruent_input::Diagnostic;

use super::{arrival::ArrivalClock, notice::LiveNotice};
use crate::event::{LogEvent, LogTopic};

/// Messages that wait at most: those of 8 s at 1 kHz, 5 MB for an arm of six joints.
const MOST_WAITING: usize = 8192;

/// What the reading thread gives.
#[derive(Debug)]
pub(super) enum Arrived {
    /// The next topic.
    Topic(LogTopic),
    Event(LogEvent),
    Notice(LiveNotice),
    /// The stream cannot be read any more.
    Failed(Diagnostic),
}

/// The end of the queue that the reading thread has.
#[derive(Debug)]
pub(crate) struct LiveQueue {
    sender: SyncSender<Arrived>,
    stop: Arc<AtomicBool>,
    pub(crate) clock: ArrivalClock,
    /// Samples that were lost since the last notice.
    lost: u64,
}

/// Nobody takes anything out of the queue any more.
#[derive(Debug)]
pub(crate) struct Closed;

impl LiveQueue {
    /// Both ends; `stop` ends the stream.
    pub(super) fn new(stop: Arc<AtomicBool>) -> (Self, Receiver<Arrived>) {
        let (sender, receiver) = sync_channel(MOST_WAITING);
        (Self { sender, stop, clock: ArrivalClock::start(), lost: 0 }, receiver)
    }

    /// Whether the stream has to end.
    pub(crate) fn is_to_stop(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    pub(crate) fn topic(&self, topic: LogTopic) -> Result<(), Closed> {
        self.send(Arrived::Topic(topic))
    }

    /// Waits while the queue is full: whoever writes into a pipe then waits, too, and nothing is lost.
    pub(crate) fn event(&self, event: LogEvent) -> Result<(), Closed> {
        self.send(Arrived::Event(event))
    }

    pub(crate) fn notice(&self, notice: LiveNotice) -> Result<(), Closed> {
        self.send(Arrived::Notice(notice))
    }

    pub(crate) fn fail(&self, why: Diagnostic) -> Result<(), Closed> {
        self.send(Arrived::Failed(why))
    }

    /// Counts a sample as lost while the queue is full: a robot does not wait. Its poses are lost with it.
    pub(crate) fn sample_or_lose(&mut self, sample: Vec<LogEvent>) -> Result<(), Closed> {
        if self.lost > 0 {
            let notice = Arrived::Notice(LiveNotice::SamplesLost { samples: self.lost });
            if self.try_send(notice)?.is_some() {
                self.lost += 1;
                return Ok(());
            }
            self.lost = 0;
        }
        for event in sample {
            if self.try_send(Arrived::Event(event))?.is_some() {
                self.lost += 1;
                break;
            }
        }
        Ok(())
    }

    /// What does not fit is given back.
    fn try_send(&self, what: Arrived) -> Result<Option<Arrived>, Closed> {
        match self.sender.try_send(what) {
            Ok(()) => Ok(None),
            Err(TrySendError::Full(what)) => Ok(Some(what)),
            Err(TrySendError::Disconnected(_)) => Err(Closed),
        }
    }

    fn send(&self, what: Arrived) -> Result<(), Closed> {
        self.sender.send(what).map_err(|_| Closed)
    }
}

impl Drop for LiveQueue {
    fn drop(&mut self) {
        if self.lost > 0 {
            let _ = self.notice(LiveNotice::SamplesLost { samples: self.lost });
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::Receiver;

    use super::*;
    use crate::event::{EventTime, LogEvent, OtherMessage};

    fn event() -> LogEvent {
        LogEvent::Other(OtherMessage { topic: 0, time: EventTime::new(0, None, 0), fault: None })
    }

    fn taken(receiver: &Receiver<Arrived>) -> Vec<Arrived> {
        receiver.try_iter().collect()
    }

    #[test]
    fn samples_that_do_not_fit_are_counted_and_said_once_there_is_room() {
        let (mut queue, receiver) = LiveQueue::new(Arc::default());
        for _ in 0..MOST_WAITING + 7 {
            queue.sample_or_lose(vec![event()]).unwrap();
        }
        assert_eq!(taken(&receiver).len(), MOST_WAITING);
        queue.sample_or_lose(vec![event()]).unwrap();
        let [Arrived::Notice(notice), Arrived::Event(_)] = &taken(&receiver)[..] else { panic!("no notice") };
        assert_eq!(*notice, LiveNotice::SamplesLost { samples: 7 });
        drop(receiver);
        assert!(queue.sample_or_lose(vec![event()]).is_err());
    }
}
