//! Paths that are logs, those that are refused, and folders with several files.

use std::fs;

use super::*;
use crate::{
    event::LogEvent,
    mcap::write::{begun, end, joints, topics},
};

/// A folder with these files.
fn folder(files: &[(&str, &[u8])]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in files {
        fs::write(folder.path().join(name), bytes).unwrap();
    }
    folder
}

fn refusal(path: &Path) -> Diagnostic {
    open_log(path, &LogOptions::default()).err().unwrap()
}

/// A log with one joint state at this time.
fn log_at(ns: u64) -> Vec<u8> {
    [begun(), topics(), joints(ns, &["elbow"], &[0.5]), end()].concat()
}

#[test]
fn logs_that_are_not_read_are_refused_with_what_to_do() {
    for (name, help) in [
        ("a.bag", "rosbags-convert"),
        ("a.bag.active", "rosbag reindex"),
        ("a.MCAP.zstd", "zstd -d"),
        ("a.db3.zstd", "zstd -d"),
    ] {
        let folder = folder(&[(name, b"whatever")]);
        let path = folder.path().join(name);
        let refused = refusal(&path);
        assert!(is_log(&path) && refused.code == codes::log::FORMAT, "{refused}");
        assert!(refused.help.unwrap().contains(help), "{name}");
    }
}

#[test]
fn what_is_no_mcap_is_refused() {
    let folder = folder(&[("text.mcap", b"some text, longer than the first bytes"), ("empty.mcap", b"")]);
    let refused = |name: &str| refusal(&folder.path().join(name)).code;
    assert_eq!(refused("text.mcap"), codes::log::NOT_MCAP);
    assert_eq!(refused("empty.mcap"), file::EMPTY);
    assert_eq!(refused("missing.mcap"), file::NOT_FOUND);
}

#[test]
fn files_of_a_bag_are_one_log_in_the_order_of_their_numbers() {
    let [first, second, tenth] = [1, 2, 3].map(log_at);
    let folder = folder(&[
        ("bag_10.mcap", &tenth),
        ("bag_2.mcap", &second),
        ("bag_0.mcap", &first),
        ("metadata.yaml", b"rosbag2_bagfile_information:\n  compression_mode: \"\"\n"),
    ]);
    assert!(is_log(folder.path()));
    let mut reader = open_log(folder.path(), &LogOptions::default()).unwrap();
    let mut times = Vec::new();
    while let Some(event) = reader.next_event().unwrap() {
        let LogEvent::Joints(joints) = event else { panic!("{event:?}") };
        times.push((joints.topic, joints.time.log_ns));
    }
    // The channels of each file are its own, the topics those of the log.
    assert_eq!((times, reader.topics().len()), (vec![(0, 1), (0, 2), (0, 3)], 2));
}

#[test]
fn a_file_that_is_not_read_costs_itself_alone() {
    let log = log_at(1);
    let whole = ("bag_1.mcap", log.as_slice());
    let gaps = |other: &str| {
        let folder = folder(&[(other, b""), whole]);
        let mut reader = open_log(folder.path(), &LogOptions::default()).unwrap();
        let events = std::iter::from_fn(|| reader.next_event().unwrap());
        events.filter(|event| matches!(event, LogEvent::Gap(_))).count()
    };
    assert_eq!((gaps("bag_0.mcap"), gaps("bag_0.mcap.zstd")), (1, 1));
    assert_eq!((gaps("._bag_1.mcap"), gaps("bag_1.mcap.zstd")), (0, 0));
}

#[test]
fn a_folder_of_a_recorder_that_was_killed_is_a_log() {
    for name in ["bag_0.mcap", "bag_0.db3", "metadata.yaml"] {
        assert!(is_log(folder(&[(name, b"")]).path()), "{name}");
        assert!(!is_log(folder(&[(name, b""), ("robot.toml", b"")]).path()), "{name}");
    }
    assert!(!is_log(folder(&[("arm.urdf", b""), ("._bag_0.mcap", b"")]).path()));
}

#[test]
fn folders_without_a_file_that_is_read_are_refused() {
    let metadata = ("metadata.yaml", b"compression_mode: FILE\n".as_slice());
    let refused = |files: &[(&str, &[u8])]| refusal(folder(files).path()).code;
    assert_eq!(refused(&[]), codes::log::FOLDER);
    assert_eq!(refused(&[metadata]), codes::log::FOLDER);
    assert_eq!(refused(&[("a.mcap", b"")]), file::EMPTY);
    assert_eq!(refused(&[metadata, ("a.db3.zstd", b"")]), codes::log::FORMAT);
    let message = ("metadata.yaml", b"  compression_mode: MESSAGE\n".as_slice());
    assert_eq!(refused(&[message, ("a.mcap", b"")]), codes::log::COMPRESSED_MESSAGES);
    assert!(!is_log(folder(&[]).path()));
}

#[test]
fn a_file_that_metadata_names_and_that_is_missing_is_said() {
    let metadata = b"rosbag2_bagfile_information:
  relative_file_paths:
    - bag_0.mcap
    - \"bag_1.mcap\"
  files:
    - path: bag_0.mcap
    - path: bag_1.mcap
";
    let (first, second) = (log_at(1), log_at(2));
    let warned = |files: &[(&str, &[u8])]| -> Vec<String> {
        let folder = folder(&[&[("metadata.yaml", metadata.as_slice())], files].concat());
        let survey = crate::survey_log(folder.path(), &LogOptions::default(), None).unwrap().survey;
        survey.warnings.into_iter().map(|warning| warning.message).collect()
    };
    assert_eq!(warned(&[("bag_0.mcap", &first), ("bag_1.mcap", &second)]), [""; 0]);
    // All were renamed.
    assert_eq!(warned(&[("a_0.mcap", &first), ("a_1.mcap", &second)]), [""; 0]);
    let said = warned(&[("bag_1.mcap", &second)]);
    assert!(said.len() == 1 && said[0].contains("not there: bag_0.mcap"), "{said:?}");
    // Nothing but the list is there.
    let alone = folder(&[("metadata.yaml", metadata.as_slice())]);
    assert_eq!(refusal(alone.path()).code, codes::log::MISSING_FILES);
}
