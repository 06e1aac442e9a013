//! What a survey warns of.

use congruent_input::{
    Diagnostic, Severity,
    display::{counted, first_of, number},
};

use super::{
    report::{JointLimitsSurvey, JointSource, PositionUnit, RobotOfLog, TopicSurvey},
    words::entries,
};
use crate::{
    cdr::{CDR, MessageKind},
    codes,
    event::{LogFormat, TopicContent},
};

/// Most names in a message.
const MOST_LISTED: usize = 8;

/// That nothing of a log can be used; an error if something could be in another encoding.
pub(super) fn nothing_read(topics: &[TopicSurvey]) -> Option<Diagnostic> {
    if topics.iter().any(has_joints_or_poses) {
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

/// Whether a topic has a message with joints or poses: one that is declared alone has none.
fn has_joints_or_poses(topic: &TopicSurvey) -> bool {
    let is_read = !matches!(topic.content, TopicContent::TimesAlone | TopicContent::Description);
    let undecoded = topic.undecoded.as_ref().map_or(0, |undecoded| undecoded.count);
    is_read && topic.messages > undecoded
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
pub(super) fn of_topics(topics: &[TopicSurvey], format: LogFormat) -> Vec<Diagnostic> {
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
        found.extend(milliseconds(topic).filter(|_| format == LogFormat::JsonLines));
        if format == LogFormat::LeRobot {
            found.extend(motor_units(topic));
            // The times of each episode begin at 0.
            continue;
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

/// Times of which the steps are those of ms. A table finds the unit by them; a line says that its time is in s.
fn milliseconds(topic: &TopicSurvey) -> Option<Diagnostic> {
    /// Shortest and longest step, s: of 1 kHz and of 1 Hz if it is one of ms.
    const STEPS: std::ops::RangeInclusive<f64> = 1.0..=1000.0;
    topic.joints.as_ref()?;
    let period_s = topic.times.as_ref()?.period_s.filter(|period_s| STEPS.contains(period_s))?;
    let message = format!(
        "the times of {} are {} s apart: as ms they would be those of {} Hz",
        topic.name,
        number(period_s),
        number(1e3 / period_s)
    );
    Some(Diagnostic::warning(codes::log::MILLISECONDS, message).with_help(
        "time_s is in s: divide by 1000 if the sender writes ms, as velocities and gaps are judged by it",
    ))
}

/// What is to be known of the unit of the positions of a dataset, which has no field for it.
fn motor_units(topic: &TopicSurvey) -> Option<Diagnostic> {
    /// Angles that joints of arms do not reach, rad: two turns.
    const MOST_RAD: f64 = 4.0 * std::f64::consts::PI;
    let ranges = topic.joints.as_ref()?.joints.iter().filter_map(|joint| joint.position_range);
    let most = ranges.flatten().map(f64::abs).fold(0.0, f64::max);
    let message = if most > MOST_RAD {
        format!(
            "positions of {} reach {most:.1}: they are in the unit of the motor bus (-100 to 100 or 0 to 100 of the calibrated range, or degrees), not rad",
            topic.name
        )
    } else {
        format!("positions of {} are read as rad: the dataset does not say their unit", topic.name)
    };
    Some(Diagnostic::warning(codes::log::MOTOR_UNITS, message).with_help(
        "rad = sign * unit_rad * value + offset_rad for each joint, by the calibration file of the arm: write it into a table with time_s and JOINT_position",
    ))
}

/// What is wrong with the log if it is of this robot.
pub(super) fn of_robot(found: &RobotOfLog) -> Vec<Diagnostic> {
    names(found).into_iter().chain(units(found)).chain(beyond_limits(found)).collect()
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
        (_, true) => finding.with_help("the robot's joints are found nevertheless"),
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

/// Angles in degrees and lengths in mm: that of the joint of each kind which exceeds its limits most.
fn units(found: &RobotOfLog) -> Vec<Diagnostic> {
    let worst = |unit: &str, si: &str, of: fn(&JointLimitsSurvey) -> Option<f64>| {
        let joints = found.limits.iter().filter(|joint| of(joint).is_some());
        let worst = joints.max_by(|a, b| a.beyond.total_cmp(&b.beyond))?;
        let (beyond, converted) = (percent(worst.beyond), percent(of(worst)?));
        let message = format!(
            "positions are {unit}: as {si} {beyond} of those of {} lie beyond its limits, as {unit} {converted}",
            worst.joint
        );
        let help = "joint states of ROS are in rad and m";
        Some(Diagnostic::warning(codes::log::UNIT, message).with_help(help))
    };
    let is_in_degrees = found.position_unit == PositionUnit::Degree;
    let degrees = is_in_degrees.then(|| worst("degrees", "rad", |joint| joint.beyond_as_degrees)).flatten();
    let is_in_millimetres = found.limits.iter().any(JointLimitsSurvey::is_in_millimetres);
    let millimetres =
        is_in_millimetres.then(|| worst("mm", "m", |joint| joint.beyond_as_millimetres)).flatten();
    degrees.into_iter().chain(millimetres).collect()
}

/// Joints whose positions fit in no unit.
fn beyond_limits(found: &RobotOfLog) -> Option<Diagnostic> {
    let beyond: Vec<String> = found
        .joints_beyond_limits()
        .map(|joint| format!("{} of those of {}", percent(joint.beyond), joint.joint))
        .collect();
    let message = format!(
        "positions lie beyond the limits, and another unit does not make them fit: {}",
        first_of(&beyond, MOST_LISTED)
    );
    (!beyond.is_empty()).then(|| Diagnostic::warning(codes::log::BEYOND_LIMITS, message))
}

fn percent(share: f64) -> String {
    format!("{:.0} %", 100.0 * share)
}
