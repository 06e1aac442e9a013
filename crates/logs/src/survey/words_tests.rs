//! A survey in words, of a small table.

use std::io::Write;

use super::*;
use crate::{ClockKind, GapsSurvey, LogOptions, survey_log};

#[test]
fn a_table_with_a_gap_a_repeated_row_and_a_missing_value() {
    let mut file = tempfile::NamedTempFile::with_suffix(".csv").unwrap();
    let mut rows: Vec<String> =
        (0..40).map(|at| format!("{},0.5,", at * 8 + if at < 20 { 0 } else { 200 })).collect();
    rows.insert(5, rows[4].clone());
    rows[9] += "0.1";
    write!(file, "time_ms,elbow_position,wrist_position\n{}\n", rows.join("\n")).unwrap();
    let survey = survey_log(file.path(), &LogOptions::default(), None).unwrap().survey;
    let words = survey_words(&survey, 5);
    assert!(words.head[0].ends_with(": table, 512 ms, 41 rows"), "{:?}", words.head);
    let read =
        "read as: separator comma, decimal point, columns have names; time in \"time_ms\", in ms by its name";
    assert_eq!(words.head[1], read);
    let name = file.path().file_name().unwrap().to_string_lossy();
    let expected = [
        format!("{name}: 2 joints with positions: elbow, wrist"),
        format!(
            "{name}: 1 gap of 208 ms from 152 ms on; 1 row repeated; 48.8 % of the positions are missing"
        ),
    ];
    assert_eq!(words.about, expected);
    assert!(
        survey_line(&survey).ends_with(&format!("; {name} 2 joints at 125 Hz")),
        "{}",
        survey_line(&survey)
    );
}

#[test]
fn durations_before_the_start_have_the_unit_of_their_size() {
    assert_eq!([-5.0, -0.5].map(duration), ["-5 s", "-500 ms"]);
}

#[test]
fn the_longest_gap_is_counted_from_the_first_message_of_its_topic() {
    // Stamps of a simulation against log times since 1970.
    let gaps = GapsSurvey { count: 1, total_s: 2.0, longest_s: 2.0, longest_from_s: -1e9 + 3.0 };
    let times = TopicTimes {
        clock: ClockKind::Stamp,
        from_s: -1e9,
        to_s: -1e9 + 9.0,
        without_stamp: 0,
        rate_hz: None,
        period_s: None,
        gaps: Some(gaps),
        repeated_messages: 0,
        repeated_stamps: 0,
        steps_back: 0,
        largest_step_back_s: 0.0,
        restarts: 0,
        mean_delay_s: None,
    };
    assert_eq!(super::gaps(&times).unwrap(), "1 gap of 2 s from 3 s on");
}

#[test]
fn rows_with_joints_and_a_pose_are_counted_once() {
    let columns = |prefix: &str| (0..6).map(|at| format!("{prefix}{at}")).collect::<Vec<_>>().join(" ");
    let rows = [0, 1, 2].map(|at| format!("{at}{}\n", " 0.1".repeat(12))).concat();
    let mut file = tempfile::NamedTempFile::with_suffix(".csv").unwrap();
    write!(file, "timestamp {} {}\n{rows}", columns("actual_q_"), columns("actual_TCP_pose_")).unwrap();
    let survey = survey_log(file.path(), &LogOptions::default(), None).unwrap().survey;
    assert_eq!((survey.messages, survey.topics.len()), (3, 2));
}
