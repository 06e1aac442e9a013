//! A stream of JSON Lines, such as standard input.

use std::{
    io::BufRead,
    sync::{Arc, atomic::AtomicBool},
};

use congruent_input::Diagnostic;

use super::{
    notice::LiveNotice,
    queue::{Closed, LiveQueue},
    reader::{LiveReader, OnNotice},
};
use crate::{
    codes,
    event::{LogEvent, LogFormat},
    json_lines::{BadLine, JsonLines, LineEvents},
};

/// Listens to a stream of lines until its end, or until `stop` is set. Its sender waits while the run is behind, so that no line is
/// lost. `on_notice` hears of lines that are no messages.
pub fn listen_to_lines(
    input: impl BufRead + Send + 'static,
    stop: Arc<AtomicBool>,
    on_notice: OnNotice,
) -> LiveReader {
    LiveReader::start(LogFormat::JsonLines, stop, on_notice, move |queue| {
        // Nobody listens any more: the run has ended.
        let _: Result<(), Closed> = read(input, &queue);
    })
}

fn read(input: impl BufRead, queue: &LiveQueue) -> Result<(), Closed> {
    let mut lines = JsonLines::new(input);
    let mut topics = 0;
    loop {
        match lines.next(|stamp_ns| queue.clock.arrives(stamp_ns)) {
            Ok(None) => return Ok(()),
            Ok(Some(Ok(LineEvents { joints, pose }))) => {
                for topic in &lines.topics()[topics..] {
                    queue.topic(topic.clone())?;
                }
                topics = lines.topics().len();
                // The pose first: it is then judged with the joints of its own line.
                pose.map_or(Ok(()), |pose| queue.event(LogEvent::Pose(pose)))?;
                joints.map_or(Ok(()), |joints| queue.event(LogEvent::Joints(joints)))?;
            }
            Ok(Some(Err(BadLine { line, message, text }))) => {
                queue.notice(LiveNotice::BadLine { line, message, text })?;
            }
            Err(error) => {
                let message = format!("the stream cannot be read behind line {}: {error}", lines.lines());
                return queue.fail(
                    Diagnostic::error(codes::log::STREAM, message)
                        .with_help("look at what writes it; what came until then was judged"),
                );
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::{cell::RefCell, rc::Rc};

    use super::*;
    use crate::event::LogReader;

    #[test]
    fn lines_come_as_events_and_bad_ones_as_notices() {
        let text = "{\"time_s\": 5, \"q\": {\"a\": 1}}\n{\n{\"time_s\": 5.5, \"q\": {\"a\": 2}}\n";
        let notices = Rc::new(RefCell::new(Vec::new()));
        let reported = Rc::clone(&notices);
        let on_notice = Box::new(move |notice| reported.borrow_mut().push(notice));
        let mut reader = listen_to_lines(text.as_bytes(), Arc::default(), on_notice);
        let mut next = || reader.next_event().unwrap();
        let (
            Some(LogEvent::Joints(first)),
            Some(LogEvent::Unusable(1)),
            Some(LogEvent::Joints(second)),
            None,
        ) = (next(), next(), next(), next())
        else {
            panic!("not two messages with a bad line between")
        };
        // The arrival of the first sets the clock; the second comes at once.
        assert_eq!((first.time.log_s, first.time.stamp_s, second.time.stamp_s), (0.0, Some(0.0), Some(0.5)));
        assert!(second.time.log_s < 0.4, "{}", second.time.log_s);
        assert!(matches!(notices.borrow()[..], [LiveNotice::BadLine { line: 2, .. }]), "{notices:?}");
    }

    #[test]
    fn a_stream_that_is_silent_ends_when_it_has_to() {
        let (silent, _sender) = std::io::pipe().unwrap();
        let stop = Arc::new(AtomicBool::new(true));
        let mut reader = listen_to_lines(std::io::BufReader::new(silent), stop, Box::new(|_| ()));
        assert_eq!(reader.next_event().unwrap(), None);
    }
}
