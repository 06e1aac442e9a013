//! What the first messages of a stream say: a stream cannot be surveyed as a whole before it is judged.

use std::path::Path;

use congruent_input::Diagnostic;
use congruent_robot::Robot;

use super::reader::LiveReader;
use crate::{
    event::{LogEvent, LogReader},
    survey::{SurveyedLog, survey_events},
};

/// How long a stream is listened to before it is judged, by its own clock, s. Kind: choice; drivers publish joints at 10 Hz and more.
const LISTENS_S: f64 = 0.5;
/// Fewest messages with joints that show a rate.
const FEWEST: usize = 3;
/// Most events that are kept until the stream is judged: of a stream without joints.
const MOST: usize = 20_000;

/// Listens to the first 0.5 s of a stream and says what is in it; its events are given once more. If its rate is known
/// the first message with joints is enough.
///
/// # Errors
/// The stream cannot be read.
pub fn survey_head(
    name: &Path,
    reader: &mut LiveReader,
    robot: &Robot,
    has_rate: HeadRate,
) -> Result<SurveyedLog, Diagnostic> {
    let mut events = Vec::new();
    let (mut messages, mut first_s) = (0, f64::NAN);
    let mut unusable = 0;
    while events.len() < MOST {
        let Some(event) = reader.next_event()? else { break };
        if let LogEvent::Unusable(messages) = event {
            // As a number: there may be any count of lines that are no messages before the first one.
            unusable += messages;
            continue;
        }
        let mut is_enough = false;
        if let LogEvent::Joints(joints) = &event {
            messages += 1;
            let time_s = joints.time.stamp_s.unwrap_or(joints.time.log_s);
            if first_s.is_nan() {
                first_s = time_s;
            }
            let is_long = messages >= FEWEST && time_s - first_s >= LISTENS_S;
            is_enough = is_long || has_rate == HeadRate::Known;
        }
        events.push(event);
        if is_enough {
            break;
        }
    }
    let surveyed = survey_events(name, &*reader, &events, robot);
    if unusable > 0 {
        events.insert(0, LogEvent::Unusable(unusable));
    }
    reader.give_again(events);
    surveyed
}

/// Whether the rate of a stream is known beside it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HeadRate {
    /// The first message with joints shows the rest.
    Known,
    /// It is that of the first messages.
    Unknown,
}
