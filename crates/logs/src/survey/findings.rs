//! What a survey warns of.

use congruent_input::{
    Diagnostic, Severity,
    display::{counted, first_of},
};

use super::{
    report::{JointSource, PositionUnit, RobotOfLog, TopicSurvey},
    words::entries,
};
use crate::{
    cdr::{CDR, MessageKind},
    codes,
    event::TopicContent,
};

/// Most names in a message.
const MOST_LISTED: usize = 8;

/// That nothing of a log can be used; an error if something could be in another encoding.
pub(super) fn nothing_read(topics: &[TopicSurvey]) -> Option<Diagnostic> {
    if topics.iter().any(|topic| topic.content != TopicContent::TimesAlone) {
        return None;
    }
    if let Some(topic) = topics.iter().find(|topic| is_in_other_encoding(topic)) {
        let refused = other_encoding(topic);
        return Some(Diagnostic { severity: Severity::Error, ..refused });
    }
    let types: Vec<&str> = topics.iter().map(|topic| topic.message_type.as_str()).collect();
    let listed = if types.is_empty() { "none".to_owned() } else { first_of(&types, MOST_LISTED) };
    Some(
        Diagnostic::warning(codes::log::NOTHING_READ, "the log has neither joint states nor poses nor TF")
            .with_help(format!("types in the log: {listed}")),
    )
}

/// Whether a topic would be read if it were encoded as ROS 2 does.
fn is_in_other_encoding(topic: &TopicSurvey) -> bool {
    let kind = MessageKind::of_type(&topic.message_type).filter(|kind| *kind != MessageKind::Text);
    topic.encoding != CDR && kind.is_some()
}

fn other_encoding(topic: &TopicSurvey) -> Diagnostic {
    let message = format!("{} is encoded as \"{}\", which is not read", topic.name, topic.encoding);
    Diagnostic::warning(codes::log::ENCODING, message).with_help(
        "convert it to CDR: `rosbags-convert --src LOG --dst FOLDER --dst-storage mcap` for a log of ROS 1",
    )
}

/// What is wrong with single topics.
pub(super) fn of_topics(topics: &[TopicSurvey]) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for topic in topics {
        if is_in_other_encoding(topic) {
            found.push(other_encoding(topic));
        }
        if let Some(undecoded) = &topic.undecoded {
            let (name, count, reason) = (&topic.name, undecoded.count, &undecoded.reason);
            let messages = entries(count, "message");
            let message = format!("{messages} of {name} cannot be decoded: {reason}");
            found.push(Diagnostic::warning(codes::log::MESSAGE, message));
        }
        if let Some(joints) = topic.joints.as_ref().filter(|joints| joints.wrong_lengths > 0) {
            let messages = entries(joints.wrong_lengths, "message");
            let message =
                format!("{messages} of {} with arrays of another length than the names", topic.name);
            found.push(Diagnostic::warning(codes::log::LENGTHS, message).with_help(
                "which value is of which joint is unknown: the values of such a message are not used",
            ));
        }
        if let Some(times) = topic.times.as_ref().filter(|times| times.restarts > 0) {
            let message = format!(
                "the times of {} go back by more than a second, {}, by {:.3} s at most",
                topic.name,
                entries(times.restarts, "time"),
                times.largest_step_back_s
            );
            found.push(Diagnostic::warning(codes::log::STAMPS, message));
        }
    }
    found
}

/// What is wrong with the log if it is of this robot.
pub(super) fn of_robot(found: &RobotOfLog) -> Vec<Diagnostic> {
    [names(found), unit(found)].into_iter().flatten().collect()
}

fn names(found: &RobotOfLog) -> Option<Diagnostic> {
    let RobotOfLog { robot, sources, missing, unknown, .. } = found;
    let other: Vec<String> = sources.iter().filter_map(other_names).collect();
    if other.is_empty() && missing.is_empty() {
        return None;
    }
    let mut parts = other;
    if !missing.is_empty() {
        parts.push(format!("joints of {robot} that are not in the log: {}", first_of(missing, MOST_LISTED)));
    }
    let message = parts.join("; ");
    let guess = |joint: &super::report::UnknownJoint| {
        let nearest = joint.nearest.as_ref().map(|near| format!(" (is it {near}?)")).unwrap_or_default();
        format!("{}{nearest}", joint.name)
    };
    let finding = Diagnostic::warning(codes::log::JOINTS, message);
    let guesses: Vec<String> = unknown.iter().map(guess).collect();
    Some(match (guesses.is_empty(), missing.is_empty()) {
        (false, false) => finding.with_help(format!(
            "joints of the log that are none of {robot}: {}",
            first_of(&guesses, MOST_LISTED)
        )),
        (_, true) => finding.with_help("the robot's joints are found in spite of that"),
        (true, false) => finding,
    })
}

/// How the names of a topic differ from those of the robot; `None` if they do not.
fn other_names(source: &JointSource) -> Option<String> {
    let JointSource { topic, prefix, suffix, prefix_of_robot, joints } = source;
    let differences = [
        (prefix, "the prefix", "more"),
        (suffix, "the suffix", "more"),
        (prefix_of_robot, "the prefix", "less"),
    ];
    let written = differences.iter().filter(|(text, ..)| !text.is_empty());
    let words: Vec<String> = written.map(|(text, what, more)| format!("{what} \"{text}\" {more}")).collect();
    let count = joints.len();
    (!words.is_empty()).then(|| {
        let (joints, have) = (counted(count, "joint"), if count == 1 { "has" } else { "have" });
        format!("the names of {joints} on {topic} {have} {} than those of the robot", words.join(" and "))
    })
}

fn unit(found: &RobotOfLog) -> Option<Diagnostic> {
    let worst = found.limits.iter().max_by(|a, b| a.beyond.total_cmp(&b.beyond))?;
    let share = |part: f64| format!("{:.0} %", 100.0 * part);
    let (joint, beyond) = (&worst.joint, share(worst.beyond));
    match found.position_unit {
        PositionUnit::Degree => {
            let message = format!(
                "positions are degrees: as rad {beyond} of those of {joint} lie beyond its limits, as degrees {}",
                share(worst.beyond_as_degrees.unwrap_or_default())
            );
            Some(
                Diagnostic::warning(codes::log::UNIT, message)
                    .with_help("joint states of ROS are in rad and m"),
            )
        }
        PositionUnit::Neither => {
            let message = format!(
                "{beyond} of the positions of {joint} lie beyond its limits, and no unit makes all fit"
            );
            Some(Diagnostic::warning(codes::log::BEYOND_LIMITS, message))
        }
        PositionUnit::Radian | PositionUnit::Unknown => None,
    }
}
