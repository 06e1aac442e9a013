//! Listens to a controller, and connects again after a loss.

use std::{
    sync::{Arc, atomic::AtomicBool},
    thread,
    time::Duration,
};

use congruent_input::Diagnostic;

use super::{connection::Connection, options::RtdeOptions, outputs::topics};
use crate::{
    event::{EventTime, LogFormat},
    live::{Closed, LiveNotice, LiveQueue, LiveReader, OnNotice},
};

/// Pauses between two attempts: the first, which doubles up to the longest. Kind: choice; a controller restarts within a minute.
const FIRST_PAUSE: Duration = Duration::from_millis(250);
const LONGEST_PAUSE: Duration = Duration::from_secs(4);
/// How often a pause is asked whether the stream has to end.
const PART_OF_PAUSE: Duration = Duration::from_millis(50);

/// Connects to a controller and listens to it until `stop` is set. A connection that is lost is opened again; what the robot did
/// meanwhile is a gap. `on_notice` hears of losses.
///
/// # Errors
/// The controller cannot be reached now, or refuses what is asked for.
pub fn listen_to_rtde(
    options: RtdeOptions,
    stop: Arc<AtomicBool>,
    on_notice: OnNotice,
) -> Result<LiveReader, Diagnostic> {
    let connection = Connection::open(&options)?;
    let rate_hz = options.rate_hz;
    let reader = LiveReader::start(LogFormat::Rtde, stop, on_notice, move |queue| {
        let mut listener = Listener { names: options.joints.to_vec().into(), options, queue, first_ns: None };
        // Nobody listens any more: the run has ended.
        let _: Result<(), Closed> = listener.listen(connection);
    });
    Ok(reader.sent_at(rate_hz))
}

struct Listener {
    options: RtdeOptions,
    queue: LiveQueue,
    names: Arc<[String]>,
    /// Time of the first message.
    first_ns: Option<i64>,
}

impl Listener {
    fn listen(&mut self, mut connection: Connection) -> Result<(), Closed> {
        topics().into_iter().try_for_each(|topic| self.queue.topic(topic))?;
        loop {
            let Some(message) = self.listen_once(&mut connection)? else {
                connection.pause();
                return Ok(());
            };
            self.queue.notice(LiveNotice::ConnectionLost { message })?;
            let Some((again, attempts)) = self.connect_again() else { return Ok(()) };
            connection = again;
            self.queue.notice(LiveNotice::ConnectedAgain { attempts })?;
        }
    }

    /// Takes states until the connection is lost, and returns why; `None` if the stream has to end.
    fn listen_once(&mut self, connection: &mut Connection) -> Result<Option<String>, Closed> {
        while !self.queue.is_to_stop() {
            let state = match connection.state() {
                Ok(Some(state)) => state,
                Ok(None) => continue,
                Err(error) => return Ok(Some(error.to_string())),
            };
            let log_ns = self.queue.clock.arrives(state.timestamp_ns);
            let first_ns = *self.first_ns.get_or_insert(log_ns);
            let time = EventTime::new(log_ns, Some(state.timestamp_ns), first_ns);
            self.queue.sample_or_lose(state.events(&self.names, time))?;
        }
        Ok(None)
    }

    /// Tries until there is a connection, with pauses that become longer; `None` if the stream has to end.
    fn connect_again(&self) -> Option<(Connection, u32)> {
        let mut pause = FIRST_PAUSE;
        for attempt in 1.. {
            let mut waited = Duration::ZERO;
            while waited < pause {
                if self.queue.is_to_stop() {
                    return None;
                }
                thread::sleep(PART_OF_PAUSE);
                waited += PART_OF_PAUSE;
            }
            if let Ok(connection) = Connection::open(&self.options) {
                return Some((connection, attempt));
            }
            pause = (2 * pause).min(LONGEST_PAUSE);
        }
        None
    }
}
