//! Logs of which nothing can be used, and those that say so.

use std::io::Write;

use super::*;
use crate::{
    codes,
    mcap::write::{begun, end, joint_data, joints, message, topic, topics},
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
    let found = survey(&[begun(), ros1, tf, joints(1, &["a"], &[0.0]), end()].concat()).unwrap();
    assert_eq!((codes_of(&found), found.survey.topics[0].messages), (vec!["log::encoding"], 1));
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
