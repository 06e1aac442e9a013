//! Words of a survey for the lines of a replay.

use congruent_logs::LogSurvey;

/// How a line begins that says what is not judged, and why.
pub const LEFT_OUT: &str = "left out: ";

/// The rate of a topic, for a line.
pub(super) fn rate(survey: &LogSurvey, topic: &str) -> String {
    let topic = survey.topics.iter().find(|of| of.name == topic);
    let rate = topic.and_then(|of| of.times.as_ref()).and_then(|times| times.rate_hz);
    rate.map_or_else(String::new, |rate| format!(", {rate:.0} Hz"))
}
