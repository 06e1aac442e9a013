//! Bags in SQLite of the corpus, those of rosbag2's own tests among them: what is in each.

#![cfg(feature = "db3")]
#![expect(
    clippy::print_stderr,
    clippy::unwrap_used,
    reason = "a skipped test says so; a helper that fails fails its test"
)]

mod support;

use std::path::Path;

use congruent_description::load_robot;
use congruent_logs::{LogFormat, LogOptions, LogSurvey, survey_log};
use support::logs;

fn surveyed(folder: &str, robot: Option<&str>) -> Option<LogSurvey> {
    let robots = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots");
    let robot = robot.map(|name| load_robot(&robots.join(name)).unwrap().robot);
    let survey = survey_log(&logs()?.join(folder), &LogOptions::default(), robot.as_ref()).unwrap().survey;
    assert_eq!(survey.format, LogFormat::Db3);
    Some(survey)
}

fn counts(survey: &LogSurvey) -> Vec<(&str, u64)> {
    let mut counts: Vec<_> =
        survey.topics.iter().map(|topic| (topic.name.as_str(), topic.messages)).collect();
    counts.sort_unstable();
    counts
}

#[test]
fn bags_of_rosbag2() {
    for (folder, messages) in [("sqlite3_talker", 20), ("sqlite3_cdr_test", 7), ("resources_empty_bag", 0)] {
        let Some(survey) = surveyed(&format!("rosbag2_samples/{folder}"), None) else { return };
        assert_eq!((survey.messages, survey.unreadable_parts), (messages, 0), "{folder}");
        let codes: Vec<_> = survey.warnings.iter().map(|warning| warning.code.as_ref()).collect();
        assert_eq!(codes, ["log::nothing_read"]);
    }
}

#[test]
fn joints_of_a_ur_with_a_tracker() {
    let Some(survey) = surveyed("synthetic/p3_ur5e_encoder_step", Some("ur5e")) else { return };
    let expected = [("/joint_states", 4000), ("/tf", 160), ("/tf_static", 1), ("/tracker/pose", 1000)];
    assert_eq!(counts(&survey), expected);
    assert!(survey.robot.unwrap().missing.is_empty() && survey.warnings.is_empty());
}

#[test]
fn joints_of_a_panda_on_three_topics_with_gaps() {
    let Some(survey) = surveyed("synthetic/p6_panda_split_gaps", Some("panda")) else { return };
    let expected = [
        ("/arm_a/joint_states", 3825),
        ("/arm_b/joint_states", 1000),
        ("/franka/ee_pose", 800),
        ("/franka_gripper/joint_states", 243),
        ("/tf", 160),
        ("/tf_static", 1),
    ];
    assert_eq!(counts(&survey), expected);
    let arm = survey.topics.iter().find(|topic| topic.name == "/arm_a/joint_states").unwrap();
    let gaps = arm.times.as_ref().unwrap().gaps.as_ref().unwrap();
    assert_eq!(gaps.count, 2);
}
