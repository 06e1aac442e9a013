//! Logs of which nothing can be used, and those that say so.

use std::io::Write;

use super::*;
use crate::{
    cdr::write::transform_text,
    codes,
    mcap::write::{begun, end, joint_data, joints, message, topic, topics},
    survey_words,
};

fn survey(bytes: &[u8]) -> Result<SurveyedLog, Diagnostic> {
    let mut file = tempfile::NamedTempFile::with_suffix(".mcap").unwrap();
    file.write_all(bytes).unwrap();
    survey_log(file.path(), &LogOptions::default(), None)
}

fn codes_of(found: &SurveyedLog) -> Vec<&str> {
    found.warnings.iter().map(|warning| warning.code.name).collect()
}

#[test]
fn joint_states_in_another_encoding_alone_are_refused() {
    let ros1 = topic(1, "/joint_states", "sensor_msgs/JointState", "ros1");
    let refused = survey(&[begun(), ros1.clone(), joints(1, &["a"], &[0.0]), end()].concat()).unwrap_err();
    assert_eq!(refused.code, codes::log::ENCODING);
    // Beside a topic that is read it is a warning.
    let tf = topic(2, "/tf", "tf2_msgs/msg/TFMessage", "cdr");
    let declared = [begun(), ros1, tf, joints(1, &["a"], &[0.0])].concat();
    let edge = transform_text(5, "base", "tool0").bytes;
    let found = survey(&[declared.clone(), message(2, 5, &edge), end()].concat()).unwrap();
    assert_eq!((codes_of(&found), found.survey.topics[0].messages), (vec!["log::encoding"], 1));
    // One that has no message is not read.
    assert_eq!(survey(&[declared, end()].concat()).unwrap_err().code, codes::log::ENCODING);
}

#[test]
fn a_log_without_joints_and_poses_says_so() {
    let image = topic(1, "/camera", "sensor_msgs/msg/Image", "cdr");
    let found = survey(&[begun(), image, message(1, 5, &[0; 9]), end()].concat()).unwrap();
    assert_eq!(codes_of(&found), ["log::nothing_read"]);
    assert!(found.warnings[0].help.as_ref().unwrap().contains("sensor_msgs/msg/Image"));
    assert_eq!(codes_of(&survey(&[begun(), end()].concat()).unwrap()), ["log::nothing_read"]);
}

#[test]
fn a_driver_that_never_sends_all_positions_is_reported() {
    let states: Vec<u8> = (1..9).flat_map(|at| joints(at, &["a", "b"], &[0.5])).collect();
    let found = survey(&[begun(), topics(), states, end()].concat()).unwrap();
    assert_eq!(codes_of(&found), ["log::lengths"]);
    let about = survey_words(&found.survey, 9).about;
    assert_eq!(about[1], "/joint_states: 8 messages with arrays of another length than the names");
}

#[test]
fn messages_that_cannot_be_decoded_say_nothing_about_those_that_can() {
    let short = &joint_data(5, &["a"], &[1.0])[..20];
    let messages = [joints(10, &["a"], &[0.0]), message(1, 11, short)];
    let found = survey(&[begun(), topics(), messages.concat(), end()].concat()).unwrap();
    let about = survey_words(&found.survey, 9).about;
    let expected = ["1 joint with positions: a", "1 message that cannot be decoded"];
    assert_eq!(about, expected.map(|words| format!("/joint_states: {words}")));
}

#[test]
fn infinite_positions_are_missing() {
    let states = [joints(1, &["a"], &[f64::INFINITY]), joints(2, &["a"], &[0.5])].concat();
    let found = survey(&[begun(), topics(), states, end()].concat()).unwrap();
    let of = found.survey.topics[0].joints.as_ref().unwrap();
    assert_eq!((of.joints[0].position_range, of.missing_values.position), (Some([0.5, 0.5]), 0.5));
}

#[test]
fn messages_that_are_written_late_do_not_shorten_the_log() {
    let states = [joints(5_000_000_000, &["a"], &[0.0]), joints(3_000_000_000, &["a"], &[0.0])].concat();
    let found = survey(&[begun(), topics(), states, end()].concat()).unwrap();
    assert!((found.survey.duration_s - 2.0).abs() < 1e-12, "{}", found.survey.duration_s);
}

#[test]
fn messages_that_cannot_be_decoded_and_clocks_that_are_set_back_are_reported() {
    let second = 1_000_000_000;
    let short = &joint_data(5, &["a"], &[1.0])[..20];
    let messages = [
        joints(10 * second, &["a"], &[0.0]),
        message(1, 11 * second, short),
        joints(3 * second, &["a"], &[0.0]),
    ];
    let found = survey(&[begun(), topics(), messages.concat()].concat()).unwrap();
    assert_eq!(codes_of(&found), ["log::truncated", "log::message", "log::stamps"]);
    assert_eq!(found.survey.unreadable_parts, 1);
    let undecoded = found.survey.topics[0].undecoded.as_ref().unwrap();
    assert_eq!((undecoded.count, found.survey.topics[0].messages), (1, 3));
}
