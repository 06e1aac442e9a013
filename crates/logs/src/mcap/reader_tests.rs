//! Whole, cut and damaged files, made by bytes.

use std::io::{Seek, Write};

use super::*;
use crate::{
    event::{LogGap, LoggedJoints, TopicContent},
    mcap::write::{begun, chunk, end, end_with_summary, joint_data, joints, message, record, topic, topics},
};

const NAMES: [&str; 2] = ["elbow", "wrist"];

fn read(bytes: &[u8]) -> Result<(Vec<LogEvent>, Vec<LogTopic>), Diagnostic> {
    let mut file = tempfile::NamedTempFile::with_suffix(".mcap").unwrap();
    file.write_all(bytes).unwrap();
    let mut reader = McapReader::new(vec![file.path().to_owned()], Vec::new());
    let mut events = Vec::new();
    while let Some(event) = reader.next_event()? {
        events.push(event);
    }
    Ok((events, reader.topics().to_vec()))
}

fn joints_of(events: &[LogEvent]) -> Vec<&LoggedJoints> {
    events
        .iter()
        .filter_map(|event| if let LogEvent::Joints(joints) = event { Some(joints) } else { None })
        .collect()
}

fn gaps(events: &[LogEvent]) -> Vec<&LogGap> {
    events.iter().filter_map(|event| if let LogEvent::Gap(gap) = event { Some(gap) } else { None }).collect()
}

/// A chunk of two messages, the second of each 0.5 s behind the first.
fn two(compression: &str, start_s: u64, before: &[u8]) -> Vec<u8> {
    let ns = [start_s * 1_000_000_000, start_s * 1_000_000_000 + 500_000_000];
    let messages = ns.map(|ns| joints(ns, &NAMES, &[0.5, 1.5])).concat();
    chunk(compression, ns, &[before, &messages].concat())
}

#[test]
fn every_compression_and_none() {
    for compression in ["", "zstd", "lz4"] {
        let image = message(2, 12_000_000_000, &[7; 5000]);
        let bytes =
            [begun(), two(compression, 10, &topics()), image, two(compression, 11, &[]), end()].concat();
        let (events, topics) = read(&bytes).unwrap();
        let found = joints_of(&events);
        assert_eq!(found.iter().map(|at| at.time.log_s).collect::<Vec<_>>(), [0.0, 0.5, 1.0, 1.5]);
        assert_eq!(
            (&found[3].names[..], &found[3].position[..]),
            (&NAMES.map(str::to_owned)[..], &[0.5, 1.5][..])
        );
        assert!(Arc::ptr_eq(&found[0].names, &found[3].names));
        assert!(gaps(&events).is_empty() && events.len() == 5);
        assert_eq!(topics[1].content, TopicContent::TimesAlone);
    }
}

#[test]
fn what_was_recorded_before_the_recorder_died_is_read() {
    let whole = [begun(), two("zstd", 10, &topics()), two("zstd", 11, &[])].concat();
    for length in [whole.len(), whole.len() - 1, whole.len() - 60] {
        let (events, _) = read(&whole[..length]).unwrap();
        assert_eq!(joints_of(&events).len(), if length == whole.len() { 4 } else { 2 });
        assert_eq!(gaps(&events)[0].cause.code, codes::log::TRUNCATED);
    }
}

#[test]
fn a_damaged_chunk_is_a_gap_with_its_times() {
    let first = [begun(), two("zstd", 10, &topics())].concat();
    let mut damaged = two("zstd", 11, &[]);
    let last = damaged.len() - 1;
    damaged[last] ^= 0x55;
    let (events, _) = read(&[first, damaged, two("lz4", 12, &[]), end()].concat()).unwrap();
    assert_eq!(joints_of(&events).len(), 4);
    let [gap] = gaps(&events)[..] else { panic!() };
    assert_eq!((gap.cause.code, gap.between_s), (codes::log::DAMAGED, Some([1.0, 1.5])));
}

#[test]
fn with_a_summary_reading_goes_on_behind_a_damaged_length() {
    let first = [begun(), two("zstd", 10, &[])].concat();
    let mut second = two("", 11, &[]);
    second[5] = 0xff;
    let third = first.len() + second.len();
    let ns = |second: u64| [second * 1_000_000_000, second * 1_000_000_000 + 500_000_000];
    let chunks = [(begun().len(), ns(10)), (first.len(), ns(11)), (third, ns(12))];
    let before = [first, second, two("lz4", 12, &[])].concat();
    let bytes = [before.clone(), end_with_summary(before.len(), &chunks, &topics())].concat();
    // No chunk declares the topics: the summary does.
    let (events, _) = read(&bytes).unwrap();
    assert_eq!(joints_of(&events).iter().map(|at| at.time.log_s).collect::<Vec<_>>(), [0.0, 0.5, 2.0, 2.5]);
    let [gap] = gaps(&events)[..] else { panic!("{events:?}") };
    assert_eq!((gap.cause.code, gap.between_s), (codes::log::DAMAGED, Some([1.0, 1.5])));
}

#[test]
fn a_chunk_whose_length_grew_does_not_swallow_the_next_one() {
    let [first, mut second, third] = [two("", 10, &topics()), two("zstd", 11, &[]), two("zstd", 12, &[])];
    let length = (second.len() - 9 + third.len()) as u64;
    second[1..9].copy_from_slice(&length.to_le_bytes());
    let (events, _) = read(&[begun(), first, second, third, end()].concat()).unwrap();
    assert_eq!(joints_of(&events).iter().map(|at| at.time.log_s).collect::<Vec<_>>(), [0.0, 0.5, 2.0, 2.5]);
    let [gap] = gaps(&events)[..] else { panic!("{events:?}") };
    assert_eq!((gap.cause.code, gap.between_s), (codes::log::DAMAGED, Some([1.0, 1.5])));
}

#[test]
fn a_channel_without_its_type_is_not_read_as_something_else() {
    let all = topics();
    // A schema is a record of its own before its channel.
    let schema_bytes = 9 + 2 + 4 + "sensor_msgs/msg/JointState".len() + 4 + "ros2msg".len() + 4;
    let without_schema = [&all[schema_bytes..], &joints(10, &NAMES, &[0.5, 1.5])].concat();
    let (events, topics) = read(&[begun(), without_schema.clone(), end()].concat()).unwrap();
    assert_eq!((gaps(&events).len(), topics.len()), (1, 1), "{topics:?}");
    let before = [begun(), without_schema].concat();
    let end = end_with_summary(before.len(), &[], &all);
    let (events, _) = read(&[before, end].concat()).unwrap();
    assert!(matches!(&events[..], [LogEvent::Joints(_)]), "{events:?}");
}

#[test]
fn a_record_that_is_too_long_is_left_out() {
    let long = MOST_RECORD_BYTES + 1;
    let mut file = tempfile::NamedTempFile::with_suffix(".mcap").unwrap();
    let head = [&begun()[..], &[op::CHUNK], &long.to_le_bytes()].concat();
    file.write_all(&head).unwrap();
    // The content is a hole in the file.
    file.as_file().set_len(head.len() as u64 + long).unwrap();
    file.seek(io::SeekFrom::End(0)).unwrap();
    file.write_all(&[two("", 10, &topics()), end()].concat()).unwrap();
    let mut reader = McapReader::new(vec![file.path().to_owned()], Vec::new());
    let events: Vec<LogEvent> = std::iter::from_fn(|| reader.next_event().unwrap()).collect();
    assert_eq!((joints_of(&events).len(), gaps(&events).len()), (2, 1));
}

#[test]
fn a_chunk_that_the_summary_has_behind_the_file_is_none() {
    let before = [begun(), two("", 10, &topics()), vec![0; 9], two("", 11, &[])].concat();
    let end = end_with_summary(before.len(), &[(1 << 40, [0, 1])], &topics());
    let (events, _) = read(&[before, end].concat()).unwrap();
    let [gap] = gaps(&events)[..] else { panic!("{events:?}") };
    assert!(gap.cause.message.contains("nothing behind it is read"), "{gap:?}");
}

#[test]
fn claims_of_a_chunk_are_not_believed() {
    let bomb = vec![0; 40 << 20];
    let mut chunk = chunk("zstd", [0, 1], &bomb);
    // It claims a byte: no more than two are decompressed.
    chunk[25..33].copy_from_slice(&1_u64.to_le_bytes());
    let (events, _) = read(&[begun(), chunk.clone(), end()].concat()).unwrap();
    assert!(gaps(&events)[0].cause.message.contains("claims 1 bytes and has more"));
    chunk[25..33].copy_from_slice(&u64::MAX.to_le_bytes());
    let (events, _) = read(&[begun(), chunk, end()].concat()).unwrap();
    assert!(gaps(&events)[0].cause.message.contains("the limit is"));
}

#[test]
fn messages_that_cannot_be_decoded_are_counted_and_compressed_ones_refused() {
    let short = message(1, 5, &joint_data(5, &NAMES, &[1.0, 2.0])[..40]);
    let (events, _) = read(&[begun(), topics(), short, end()].concat()).unwrap();
    let [LogEvent::Other(other)] = &events[..] else { panic!("{events:?}") };
    assert!(other.fault.as_ref().unwrap().contains("bytes follow"), "{other:?}");
    let compressed = message(1, 5, &[0x28, 0xb5, 0x2f, 0xfd, 0, 0]);
    let refused = read(&[begun(), topics(), compressed, end()].concat()).unwrap_err();
    assert_eq!(refused.code, codes::log::COMPRESSED_MESSAGES);
}

#[test]
fn records_that_nobody_needs_are_not_parsed() {
    // The parser takes the sum at the end of an attachment off its content, which is too short for one.
    let attachment = record(op::ATTACHMENT, &[0; 32]);
    let records = [topics(), attachment.clone(), joints(10, &NAMES, &[0.5, 1.5])].concat();
    let before = [begun(), chunk("", [10, 10], &records)].concat();
    let end = end_with_summary(before.len(), &[(begun().len(), [10, 10])], &attachment);
    let (events, _) = read(&[before, end].concat()).unwrap();
    assert!(matches!(&events[..], [LogEvent::Joints(_)]), "{events:?}");
}

#[test]
fn a_cut_frame_of_lz4_costs_its_own_chunk_alone() {
    let mut cut = chunk("lz4", [11, 11], &joints(11, &NAMES, &[0.5, 1.5]));
    // The last four bytes of a frame are its end mark.
    cut.truncate(cut.len() - 4);
    let length = (cut.len() - 9) as u64;
    cut[1..9].copy_from_slice(&length.to_le_bytes());
    let compressed = 9 + 8 + 8 + 8 + 4 + 4 + 3;
    let size = (cut.len() - compressed - 8) as u64;
    cut[compressed..compressed + 8].copy_from_slice(&size.to_le_bytes());
    let whole = [two("lz4", 10, &topics()), cut, two("lz4", 12, &[])].concat();
    let (events, _) = read(&[begun(), whole, end()].concat()).unwrap();
    assert!(joints_of(&events).len() >= 4 && gaps(&events).len() <= 1, "{events:?}");
}

#[test]
fn other_encodings_are_listed_and_not_read() {
    let ros1 = topic(1, "/joint_states", "sensor_msgs/JointState", "ros1");
    let (events, topics) = read(&[begun(), ros1, joints(5, &NAMES, &[0.0, 0.0]), end()].concat()).unwrap();
    assert!(matches!(&events[..], [LogEvent::Other(_)]));
    assert_eq!((topics[0].encoding.as_str(), topics[0].content), ("ros1", TopicContent::TimesAlone));
}
