//! Tables and datasets, written as other programs do.

use std::fs;

use congruent_input::Finding;
use parquet::basic::Compression;

use super::super::write::{StateRow, dataset_file, table_file};
use crate::{
    LogEvent, LogFormat, LogOptions, LogSurvey, codes,
    event::LoggedJoints,
    is_log,
    mutation_tests::{Numbers, mutated},
    open_log, survey_log,
    table_reading::TableEpisodes,
};

use super::*;

fn read(path: &Path) -> Vec<LogEvent> {
    let mut reader = open_log(path, &LogOptions::default()).unwrap();
    std::iter::from_fn(|| reader.next_event().unwrap()).collect()
}

fn joints(events: &[LogEvent]) -> Vec<&LoggedJoints> {
    events
        .iter()
        .filter_map(|event| if let LogEvent::Joints(joints) = event { Some(joints) } else { None })
        .collect()
}

fn surveyed(path: &Path) -> LogSurvey {
    survey_log(path, &LogOptions::default(), None).unwrap().survey
}

fn codes_of(survey: &LogSurvey) -> Vec<&str> {
    survey.warnings.iter().map(|finding: &Finding| finding.code.as_ref()).collect()
}

/// An episode at 30 Hz whose first joint goes up to this value.
fn episode(episode: i64, most: f32) -> Vec<StateRow> {
    let row = |at: u8| {
        let share = f32::from(at) / 59.0;
        StateRow { episode, timestamp_s: f32::from(at) / 30.0, state: vec![share * most, 0.5] }
    };
    (0..60).map(row).collect()
}

const INFO: &str = r#"{"codebase_version": "v3.0", "fps": 30, "features": {"observation.state":
    {"dtype": "float32", "shape": [2], "names": {"motors": ["shoulder_pan.pos", "gripper"]}}}}"#;

/// A dataset with these files, each of one episode.
fn dataset(files: &[(&str, Vec<StateRow>)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let chunk = folder.path().join("data/chunk-000");
    fs::create_dir_all(&chunk).unwrap();
    fs::create_dir(folder.path().join("meta")).unwrap();
    fs::write(folder.path().join("meta/info.json"), INFO).unwrap();
    for (name, rows) in files {
        dataset_file(&chunk.join(name), &[rows[..30].to_vec(), rows[30..].to_vec()]);
    }
    folder
}

#[test]
fn a_table_is_read_as_one_in_csv() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("log.parquet");
    let columns = [
        ("time_ms", vec![0.0, 8.0, 16.0]),
        ("elbow_position_deg", vec![180.0, 90.0, f64::NAN]),
        ("elbow_velocity", vec![0.1, 0.2, 0.3]),
        ("temperature", vec![20.0; 3]),
    ];
    for compression in [Compression::UNCOMPRESSED, Compression::SNAPPY] {
        table_file(&path, &columns, compression);
        assert!(is_log(&path));
        let events = read(&path);
        let found = joints(&events);
        assert_eq!(found.iter().map(|row| row.time.log_s).collect::<Vec<_>>(), [0.0, 0.008, 0.016]);
        assert_eq!(found[0].position[0].to_bits(), 180_f64.to_radians().to_bits());
        assert!(found[2].position[0].is_nan());
    }
    let survey = surveyed(&path);
    assert_eq!((survey.format, survey.messages), (LogFormat::Parquet, 3));
    assert_eq!(survey.table.unwrap().unused, ["temperature"]);
    assert!(survey.warnings.is_empty(), "{:?}", survey.warnings);
}

#[test]
fn a_file_that_is_not_read_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("log.parquet");
    table_file(&path, &[("t", vec![0.0, 1.0]), ("q1", vec![0.0, 1.0])], Compression::SNAPPY);
    let whole = fs::read(&path).unwrap();
    fs::write(&path, &whole[..whole.len() - 10]).unwrap();
    let refused = open_log(&path, &LogOptions::default()).err().unwrap();
    assert_eq!(refused.code, codes::log::PARQUET);
    assert!(refused.help.unwrap().contains("compression=\"snappy\""));
}

#[test]
fn names_and_episodes_of_a_dataset() {
    let folder = dataset(&[("file-001.parquet", episode(1, 90.0)), ("file-000.parquet", episode(0, 98.5))]);
    assert!(is_log(folder.path()));
    let events = read(folder.path());
    let found = joints(&events);
    assert_eq!(
        (found.len(), &found[0].names[..]),
        (120, &["shoulder_pan", "gripper"].map(str::to_owned)[..])
    );
    assert!((found[59].position[0] - 98.5).abs() < 1e-4);
    // The second episode begins at 0 again.
    assert_eq!((found[59].time.log_ns, found[60].time.log_ns), (1_966_666_700, 0));
    let survey = surveyed(folder.path());
    assert_eq!(survey.format, LogFormat::LeRobot);
    assert_eq!(survey.topics[0].times.as_ref().unwrap().restarts, 1);
    assert_eq!(codes_of(&survey), ["log::motor_units"]);
    let message = &survey.warnings[0].message;
    assert!(message.contains("reach 98.5") && message.contains("not rad"), "{message}");
    // A file by itself knows its dataset.
    let file = folder.path().join("data/chunk-000/file-001.parquet");
    assert_eq!(joints(&read(&file))[0].names, found[0].names);
}

#[test]
fn what_is_not_read_of_a_dataset_is_said() {
    let with_info = |info: &str| {
        let folder = dataset(&[("file-000.parquet", episode(0, 1.0))]);
        fs::write(folder.path().join("meta/info.json"), info).unwrap();
        surveyed(folder.path())
    };
    let whole = with_info(INFO);
    assert_eq!(whole.table.unwrap().unused, ["observation.image (text or bytes)", "episode_index"]);
    let short = INFO.replace("\"shoulder_pan.pos\", ", "");
    for (info, part) in [
        ("{", "is no JSON"),
        ("{}", "has no names of the values of observation.state"),
        (short.as_str(), "names 1 values of observation.state, which has 2"),
    ] {
        let survey = with_info(info);
        assert_eq!(
            (codes_of(&survey).last(), survey.unreadable_parts),
            (Some(&"log::motor_units"), 0),
            "{info}"
        );
        let said = survey.warnings.iter().find(|warning| warning.code == "log::state_names").unwrap();
        assert!(said.message.contains(part) && said.message.contains("joint_1 to joint_2"), "{said:?}");
    }
}

#[test]
fn one_episode_is_read_alone_wherever_it_is() {
    let both = [episode(3, 0.3), episode(4, 0.4)].concat();
    let folder = dataset(&[("file-000.parquet", episode(2, 0.2)), ("file-001.parquet", both)]);
    let options = |episode| LogOptions { episode: Some(episode), ..LogOptions::default() };
    for (index, most) in [(2, 0.2), (3, 0.3), (4, 0.4)] {
        let survey = survey_log(folder.path(), &options(index), None).unwrap().survey;
        let found = survey.table.unwrap().episodes.unwrap();
        let expected = TableEpisodes { count: 3, first: 2, last: 4, taken: Some(index) };
        assert_eq!((found, survey.messages), (expected, 60));
        let mut reader = open_log(folder.path(), &options(index)).unwrap();
        let events: Vec<LogEvent> = std::iter::from_fn(|| reader.next_event().unwrap()).collect();
        assert!((joints(&events)[59].position[0] - most).abs() < 1e-6);
    }
    let refused = open_log(folder.path(), &options(5)).err().unwrap();
    assert_eq!(refused.code, codes::log::EPISODE);
    assert!(refused.message.ends_with("has no episode 5; its episodes are 2 to 4"), "{}", refused.message);
    let words = crate::survey_words(&surveyed(folder.path()), 5);
    assert!(words.head[0].contains("3 episodes (indices 2 to 4), 180 rows"), "{:?}", words.head);
    // A log without episodes does not ignore the option.
    let table = folder.path().join("log.parquet");
    table_file(&table, &[("t", vec![0.0, 1.0]), ("q1", vec![0.0, 1.0])], Compression::SNAPPY);
    let csv = folder.path().join("log.csv");
    fs::write(&csv, "time_s,q1\n0,0\n0.1,1\n").unwrap();
    for path in [table, csv] {
        assert_eq!(open_log(&path, &options(0)).err().unwrap().code, codes::log::EPISODE);
    }
}

#[test]
fn a_dataset_of_small_values_may_be_in_rad() {
    let folder = dataset(&[("episode_000000.parquet", episode(0, 1.5))]);
    let survey = surveyed(folder.path());
    assert_eq!(codes_of(&survey), ["log::motor_units"]);
    assert!(survey.warnings[0].message.contains("does not say their unit"), "{:?}", survey.warnings);
}

#[test]
fn a_damaged_file_of_a_dataset_costs_itself_alone() {
    let files = ["file-000.parquet", "file-001.parquet", "file-002.parquet"];
    let folder = dataset(&files.map(|name| (name, episode(0, 1.0))));
    fs::write(folder.path().join("data/chunk-000").join(files[1]), b"PAR1 no end").unwrap();
    let events = read(folder.path());
    let gaps = events.iter().filter(|event| matches!(event, LogEvent::Gap(_))).count();
    assert_eq!((joints(&events).len(), gaps), (120, 1));
}

#[test]
fn changed_files_are_read_or_refused() {
    let folder = dataset(&[("file-000.parquet", episode(0, 1.0))]);
    let path = folder.path().join("data/chunk-000/file-000.parquet");
    let whole = fs::read(&path).unwrap();
    let mut numbers = Numbers(0x9e37_79b9_7f4a_7c15);
    let mut read = 0;
    for _ in 0..600 {
        fs::remove_file(&path).unwrap();
        fs::write(&path, mutated(&whole, &mut numbers)).unwrap();
        read += usize::from(survey_log(&path, &LogOptions::default(), None).is_ok());
    }
    // Most of so small a file says where its columns are.
    assert!(read > 50, "{read}");
}
