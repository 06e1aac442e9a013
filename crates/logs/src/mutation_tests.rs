//! Damaged logs: whatever is changed in a file, its reader ends and gives a survey or a refusal.

use std::{
    io::Write,
    path::{Path, PathBuf},
};

use crate::{
    LogOptions,
    cdr::{MessageKind, write::transform_text},
    mcap::write::{begun, chunk, end_with_summary, joints, message, topic, topics},
    survey_log,
};

/// Numbers that are the same on every machine (xorshift, Marsaglia 2003).
pub(crate) struct Numbers(pub(crate) u64);

impl Numbers {
    fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        usize::try_from(self.0 % u64::try_from(limit.max(1)).unwrap()).unwrap()
    }
}

/// Changes one to four places.
pub(crate) fn mutated(bytes: &[u8], numbers: &mut Numbers) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..=numbers.below(4) {
        let at = numbers.below(bytes.len());
        let end = (at + 1 + numbers.below(40)).min(bytes.len());
        match numbers.below(7) {
            0 => bytes.truncate(at),
            1 => drop(bytes.drain(at..end)),
            2 => {
                let part = bytes[at..end].to_vec();
                drop(bytes.splice(at..at, part));
            }
            3 => bytes[at..end].fill(0xff),
            4 => bytes[at..end].fill(0),
            _ => {
                let bit = numbers.below(8);
                bytes[at] ^= 1 << bit;
            }
        }
        if bytes.is_empty() {
            break;
        }
    }
    bytes
}

/// A file that is written over and over.
struct Scratch {
    folder: tempfile::TempDir,
    ending: &'static str,
}

impl Scratch {
    fn new(ending: &'static str) -> Self {
        Self { folder: tempfile::tempdir().unwrap(), ending }
    }

    fn survey(&self, bytes: &[u8], options: &LogOptions) -> bool {
        let path = self.folder.path().join("log").with_extension(self.ending);
        // A new file each time: some file systems write a file to the disk at once that replaces its own content.
        let _ = std::fs::remove_file(&path);
        std::fs::File::create(&path).unwrap().write_all(bytes).unwrap();
        survey_log(&path, options, None).is_ok()
    }
}

/// Surveys `count` mutations; returns how many were read.
fn survey_mutations(bytes: &[u8], ending: &'static str, count: usize) -> usize {
    let (scratch, mut numbers) = (Scratch::new(ending), Numbers(0x9e37_79b9_7f4a_7c15));
    let options =
        LogOptions { joints: vec!["elbow".to_owned(), "wrist".to_owned()], ..LogOptions::default() };
    assert!(scratch.survey(bytes, &options), "the whole log is read");
    (0..count).filter(|_| scratch.survey(&mutated(bytes, &mut numbers), &options)).count()
}

/// Whether chunks have sums.
#[derive(Clone, Copy, PartialEq)]
enum Sums {
    Written,
    None,
}

/// A small log of two chunks with a summary. Without sums, changes in a chunk reach what is behind them.
fn small_log(compression: &str, sums: Sums) -> Vec<u8> {
    let tf = topic(3, "/tf", "tf2_msgs/msg/TFMessage", "cdr");
    let states = |from: u64| -> Vec<u8> {
        (from..from + 5).flat_map(|at| joints(at * 1_000_000, &["elbow", "wrist"], &[0.1, 0.2])).collect()
    };
    let edge = message(3, 3_000_000, &transform_text(3_000_000, "base", "tool0").bytes);
    let chunks = [
        chunk(compression, [0, 4], &[topics(), tf, states(1), edge].concat()),
        chunk(compression, [5, 9], &states(6)),
    ];
    let mut bytes = begun();
    let mut places = Vec::new();
    for mut chunk in chunks {
        if sums == Sums::None {
            chunk[33..37].fill(0);
        }
        places.push((bytes.len(), [0, 9]));
        bytes.extend(chunk);
    }
    let end = end_with_summary(bytes.len(), &places, &topics());
    bytes.extend(end);
    bytes
}

#[test]
fn changed_logs_are_read_or_refused() {
    for (compression, sums) in
        [("", Sums::None), ("", Sums::Written), ("zstd", Sums::None), ("lz4", Sums::None)]
    {
        let read = survey_mutations(&small_log(compression, sums), "mcap", 800);
        assert!(read > 500, "{compression}: {read}");
    }
}

#[test]
fn changed_tables_are_read_or_refused() {
    let rows: Vec<String> = (0..40).map(|at| format!("{};{at},5;nan;", f64::from(at) / 125.0)).collect();
    let header = "time_s;elbow_position;wrist_position;elbow_velocity";
    let table = format!("{header}\n{}\n", rows.join("\n").replace('.', ","));
    let read = survey_mutations(table.as_bytes(), "csv", 1500);
    assert!(read > 500, "{read}");
}

#[test]
fn changed_lines_are_read_or_refused() {
    let line = |at| {
        format!("{{\"time_s\": {}, \"q\": {{\"elbow\": {at}, \"wrist\": null}}}}", f64::from(at) / 125.0)
    };
    let lines: Vec<String> = (0..40).map(line).collect();
    let read = survey_mutations(lines.join("\n").as_bytes(), "jsonl", 1500);
    assert!(read > 500, "{read}");
}

#[test]
fn changed_messages_are_decoded_or_refused() {
    let mut numbers = Numbers(7);
    let kinds = [
        MessageKind::JointState,
        MessageKind::Pose,
        MessageKind::Transform,
        MessageKind::Transforms,
        MessageKind::Text,
    ];
    let whole = transform_text(3_000_000, "base", "tool0").bytes;
    for _ in 0..20_000 {
        let message = mutated(&whole, &mut numbers);
        for kind in kinds {
            drop(kind.decode(&message));
        }
    }
}

/// Files that other programs have written, from the corpus.
#[test]
#[expect(clippy::print_stderr, reason = "a skipped test says so")]
fn changed_files_of_the_corpus_are_read_or_refused() {
    let Some(corpus) = std::env::var_os("CONGRUENT_CORPUS") else {
        eprintln!("skipped: CONGRUENT_CORPUS is not set");
        return;
    };
    let logs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(corpus).join("logs");
    let read = |path: &str| std::fs::read(PathBuf::from(&logs).join(path)).unwrap();
    for (path, ending, bytes) in [
        ("rosbag2_samples/mcap_talker/talker.mcap", "mcap", usize::MAX),
        ("rosbag2_samples/mcap_cdr_test/cdr_test_0.mcap", "mcap", usize::MAX),
        ("synthetic/p5_ur5e_degrees_prefix.mcap", "mcap", 60_000),
        ("tiago_joint_states/tiago_position.csv", "csv", 10_000),
        ("ur10e_camera_pose/calibration.csv", "csv", usize::MAX),
    ] {
        let mut file = read(path);
        file.truncate(bytes);
        let options = LogOptions { rate_hz: Some(10.0), ..LogOptions::default() };
        let (scratch, mut numbers) = (Scratch::new(ending), Numbers(3));
        for _ in 0..200 {
            scratch.survey(&mutated(&file, &mut numbers), &options);
        }
    }
}
