//! Logs of the corpus, whose defects are known: each survey against the truth beside its log.

#![expect(
    clippy::print_stderr,
    clippy::unwrap_used,
    reason = "a skipped test says so; a helper that fails fails its test"
)]

mod support;

use std::path::Path;

use congruent_description::{Robot, load_robot};
use congruent_input::Diagnostic;
use congruent_logs::{
    DecimalMark, JointsSurvey, LogOptions, LogSurvey, PositionUnit, SurveyedLog, TableEncoding, TableTime,
    TimeUnit, TopicSurvey, survey_log,
};
use support::logs;

fn robot(name: &str) -> Robot {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots").join(name);
    load_robot(&folder).unwrap().robot
}

fn survey_of(path: &Path, robot: Option<&Robot>) -> Result<SurveyedLog, Diagnostic> {
    survey_log(path, &LogOptions::default(), robot)
}

fn surveyed(name: &str, robot: Option<&Robot>) -> Option<LogSurvey> {
    Some(survey_of(&logs()?.join("synthetic").join(name), robot).unwrap().survey)
}

fn topic<'a>(survey: &'a LogSurvey, name: &str) -> &'a TopicSurvey {
    survey.topics.iter().find(|topic| topic.name == name).unwrap()
}

fn joints(topic: &TopicSurvey) -> &JointsSurvey {
    topic.joints.as_ref().unwrap()
}

fn codes(survey: &LogSurvey) -> Vec<&str> {
    survey.warnings.iter().map(|warning| warning.code.as_ref()).collect()
}

/// Of a rate that is a number of messages over a duration. Kind: choice; the truth has whole numbers.
const RATE_SHARE: f64 = 2e-2;

#[track_caller]
fn has_rate(topic: &TopicSurvey, expected_hz: f64) {
    let rate_hz = topic.times.as_ref().unwrap().rate_hz.unwrap();
    assert!((rate_hz / expected_hz - 1.0).abs() < RATE_SHARE, "{}: {rate_hz}", topic.name);
}

#[test]
fn a_clean_log_of_500_hz() {
    let Some(survey) = surveyed("p1_ur5e_clean_500hz.mcap", Some(&robot("ur5e"))) else { return };
    let counts: Vec<(&str, u64)> =
        survey.topics.iter().map(|topic| (topic.name.as_str(), topic.messages)).collect();
    for expected in [
        ("/joint_states", 4000),
        ("/robot_description", 1),
        ("/tcp_pose_broadcaster/pose", 1000),
        ("/tf", 160),
        ("/tf_static", 1),
    ] {
        assert!(counts.contains(&expected), "{counts:?}");
    }
    let states = topic(&survey, "/joint_states");
    has_rate(states, 500.0);
    has_rate(topic(&survey, "/tcp_pose_broadcaster/pose"), 125.0);
    has_rate(topic(&survey, "/tf"), 20.0);
    let times = states.times.as_ref().unwrap();
    assert_eq!((times.gaps.as_ref(), times.steps_back, times.repeated_messages), (None, 0, 0));
    assert_eq!((joints(states).joints.len(), joints(states).incomplete), (6, 0));
    let of_robot = survey.robot.as_ref().unwrap();
    assert_eq!((of_robot.position_unit, of_robot.missing.len()), (PositionUnit::Radian, 0));
    // /tf_static is recorded half a second before the rest.
    assert_eq!(survey.begun.as_deref(), Some("2025-10-09T08:53:19Z"));
    let description = survey.description.as_ref().unwrap();
    assert!(description.robot.as_deref() == Some("ur5e") && description.bytes > 1000, "{description:?}");
    assert!(survey.warnings.is_empty(), "{:?}", survey.warnings);
}

#[test]
fn joints_in_changing_order_some_missing_some_nan() {
    let Some(survey) = surveyed("p2_ur5e_order_missing_nan.mcap", Some(&robot("ur5e"))) else { return };
    let joints = joints(topic(&survey, "/joint_states"));
    assert_eq!((joints.incomplete, joints.wrong_lengths, joints.without_velocities), (415, 3, 600));
    let missing = |name: &str| joints.joints.iter().find(|joint| joint.name == name).unwrap().missing_in;
    let missing = ["shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3"]
        .map(|name| missing(&format!("{name}_joint")));
    assert_eq!(missing, [71, 59, 67, 82, 71, 65]);
    assert!(joints.order_changes > 2000);
    // 100 of 3000 messages.
    assert!((joints.missing_values.position - 1.0 / 30.0).abs() < 2e-3, "{:?}", joints.missing_values);
    assert_eq!(survey.robot.unwrap().position_unit, PositionUnit::Radian);
}

#[test]
fn stamps_that_go_back_and_repeat() {
    let Some(survey) = surveyed("p4_panda_two_clocks.mcap", Some(&robot("panda"))) else { return };
    let states = topic(&survey, "/franka/joint_states");
    let times = states.times.as_ref().unwrap();
    assert_eq!((states.messages, times.steps_back, times.restarts), (6028, 1536, 0));
    assert_eq!((times.repeated_messages, times.repeated_stamps), (28, 62));
    assert_eq!(times.gaps, None);
    has_rate(states, 1000.0);
    // Log time is 1.5 ms and the mean of a half normal distribution behind the stamps, which are 35 ms ahead on the other topic.
    let delay = |name| topic(&survey, name).times.as_ref().unwrap().mean_delay_s.unwrap();
    assert!((delay("/franka/joint_states") - 0.0031).abs() < 3e-4);
    assert!((delay("/mocap/panda_tcp/pose") + 0.025).abs() < 2e-3);
}

#[test]
fn degrees_and_a_prefix() {
    let Some(survey) = surveyed("p5_ur5e_degrees_prefix.mcap", Some(&robot("ur5e"))) else { return };
    let of_robot = survey.robot.as_ref().unwrap();
    let [source] = &of_robot.sources[..] else { panic!("{:?}", of_robot.sources) };
    assert_eq!((source.prefix.as_str(), source.joints.len()), ("left_", 6));
    assert_eq!(of_robot.position_unit, PositionUnit::Degree);
    assert_eq!(codes(&survey), ["log::joints", "log::unit"]);
    let frames = &topic(&survey, "/left/tcp_pose").frames;
    assert_eq!(frames[0].frame, "left/base");
}

#[test]
fn tiago_as_an_mcap_and_as_tables() {
    let Some(logs) = logs() else { return };
    let folder = logs.join("tiago_joint_states");
    let mcap = survey_of(&folder.join("tiago.mcap"), None).unwrap().survey;
    let [states] = &mcap.topics[..] else { panic!("{:?}", mcap.topics) };
    let table = survey_of(&folder.join("tiago_position.csv"), None).unwrap().survey;
    let [rows] = &table.topics[..] else { panic!() };
    assert_eq!(states.messages, rows.messages);
    has_rate(rows, 100.0);
    let ranges = |topic: &TopicSurvey| -> Vec<(String, Option<[f64; 2]>)> {
        joints(topic).joints.iter().map(|joint| (joint.name.clone(), joint.position_range)).collect()
    };
    assert_eq!(ranges(rows), ranges(states));
    let reading = table.table.unwrap();
    assert_eq!(reading.text.unwrap().encoding, TableEncoding::Utf8);
    assert!(matches!(reading.time, TableTime::Column { unit: TimeUnit::Second, .. }), "{:?}", reading.time);
    let speeds = survey_of(&folder.join("tiago_velocity.csv"), None).unwrap().survey;
    let joints = joints(&speeds.topics[0]);
    assert!(joints.joints[0].largest_velocity.is_some() && joints.without_positions == rows.messages);
}

#[test]
fn a_table_with_decimal_commas_by_the_names_of_a_robot() {
    let Some(logs) = logs() else { return };
    let path = logs.join("ur10_laser_ipa/series_b.csv");
    let refused = survey_of(&path, Some(&robot("ur5e"))).unwrap_err();
    assert_eq!(refused.code.name, "log::time", "{refused}");
    let options = LogOptions { rate_hz: Some(1.0), ..LogOptions::default() };
    let survey = survey_log(&path, &options, Some(&robot("ur5e"))).unwrap().survey;
    let reading = survey.table.unwrap();
    assert!(reading.text.unwrap().decimal == DecimalMark::Comma && reading.columns.len() == 6, "{reading:?}");
    assert_eq!(survey.robot.unwrap().missing.len(), 0);
}

#[test]
fn bags_of_rosbag2() {
    let Some(logs) = logs() else { return };
    let bags = logs.join("rosbag2_samples");
    for (bag, messages) in [("mcap_talker", 20), ("mcap_cdr_test", 7)] {
        let survey = survey_of(&bags.join(bag), None).unwrap().survey;
        assert!(survey.messages >= messages, "{bag}: {}", survey.messages);
        assert_eq!(codes(&survey), ["log::nothing_read"]);
    }
    let refused = survey_of(&logs.join("synthetic/x1_ur5e_file_zstd"), None).unwrap_err();
    assert_eq!(refused.code.name, "log::format");
    assert!(refused.help.unwrap().contains("zstd -d"));
}

/// The test of a program with the feature `db3` is in `db3.rs`.
#[cfg(not(feature = "db3"))]
#[test]
fn bags_in_sqlite_are_refused_without_their_feature() {
    let Some(logs) = logs() else { return };
    for folder in ["sqlite3_talker", "sqlite3_cdr_test", "resources_empty_bag"] {
        let refused = survey_of(&logs.join("rosbag2_samples").join(folder), None).unwrap_err();
        assert_eq!(refused.code.name, "log::format");
        let help = refused.help.unwrap();
        assert!(help.contains("--features db3") && help.contains("ros2 bag convert"), "{help}");
    }
}
