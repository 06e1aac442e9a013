//! Writes small MCAP files, for tests: by bytes, so that what reads them is held against the format.

use mcap::{MAGIC, records::op};

use crate::cdr::write::{ByteOrder, CdrText, joint_state_text};

/// The beginning of a file; records follow.
pub(crate) fn begun() -> Vec<u8> {
    let mut bytes = MAGIC.to_vec();
    bytes.extend(record(op::HEADER, &[text("ros2"), text("test")].concat()));
    bytes
}

/// The end of a file without a summary.
pub(crate) fn end() -> Vec<u8> {
    let mut bytes = record(op::DATA_END, &[0; 4]);
    bytes.extend(record(op::FOOTER, &[0; 20]));
    bytes.extend(MAGIC);
    bytes
}

/// The end of a file whose chunks begin at these places; the summary has these records as well.
pub(crate) fn end_with_summary(before: usize, chunks: &[(usize, [u64; 2])], records: &[u8]) -> Vec<u8> {
    let mut bytes = record(op::DATA_END, &[0; 4]);
    let start = before + bytes.len();
    bytes.extend(records);
    for (at, times) in chunks {
        let mut index = Vec::new();
        for value in [times[0], times[1], *at as u64, 1] {
            index.extend(value.to_le_bytes());
        }
        index.extend([0; 4 + 8 + 4 + 8 + 8]);
        bytes.extend(record(op::CHUNK_INDEX, &index));
    }
    let mut footer = (start as u64).to_le_bytes().to_vec();
    footer.extend([0; 12]);
    bytes.extend(record(op::FOOTER, &footer));
    bytes.extend(MAGIC);
    bytes
}

pub(crate) fn record(code: u8, content: &[u8]) -> Vec<u8> {
    let mut bytes = vec![code];
    bytes.extend((content.len() as u64).to_le_bytes());
    bytes.extend(content);
    bytes
}

fn text(text: &str) -> Vec<u8> {
    let mut bytes = u32::try_from(text.len()).unwrap().to_le_bytes().to_vec();
    bytes.extend(text.as_bytes());
    bytes
}

/// A topic: its schema and its channel have the same number.
pub(crate) fn topic(number: u16, name: &str, message_type: &str, encoding: &str) -> Vec<u8> {
    let number = number.to_le_bytes();
    let schema = [&number[..], &text(message_type), &text("ros2msg"), &[0; 4]].concat();
    let channel = [&number[..], &number, &text(name), &text(encoding), &[0; 4]].concat();
    [record(op::SCHEMA, &schema), record(op::CHANNEL, &channel)].concat()
}

/// Topic 1 has joint states, topic 2 what nobody reads.
pub(crate) fn topics() -> Vec<u8> {
    let joints = topic(1, "/joint_states", "sensor_msgs/msg/JointState", "cdr");
    [joints, topic(2, "/camera", "sensor_msgs/msg/Image", "cdr")].concat()
}

pub(crate) fn message(channel: u16, log_ns: u64, data: &[u8]) -> Vec<u8> {
    let mut content = channel.to_le_bytes().to_vec();
    content.extend([0; 4]);
    content.extend(log_ns.to_le_bytes());
    content.extend(log_ns.to_le_bytes());
    content.extend(data);
    record(op::MESSAGE, &content)
}

/// A joint state with these positions, as a message of topic 1 that is recorded when it is true.
pub(crate) fn joints(ns: u64, names: &[&str], position: &[f64]) -> Vec<u8> {
    message(1, ns, &joint_data(i64::try_from(ns).unwrap(), names, position))
}

pub(crate) fn joint_data(stamp_ns: i64, names: &[&str], position: &[f64]) -> Vec<u8> {
    let mut text = CdrText::new(ByteOrder::Little);
    joint_state_text(&mut text, stamp_ns, names.iter().copied());
    text.f64_list(position);
    text.f64_list(&[]);
    text.f64_list(&[]);
    text.bytes
}

/// A chunk of records in this compression, with the times that it claims.
pub(crate) fn chunk(compression: &str, times: [u64; 2], records: &[u8]) -> Vec<u8> {
    let compressed = match compression {
        "zstd" => ruzstd::encoding::compress_to_vec(records, ruzstd::encoding::CompressionLevel::Fastest),
        "lz4" => {
            let mut encoder = lz4_flex::frame::FrameEncoder::new(Vec::new());
            std::io::Write::write_all(&mut encoder, records).unwrap();
            encoder.finish().unwrap()
        }
        _ => records.to_vec(),
    };
    let mut content = Vec::new();
    for time in times {
        content.extend(time.to_le_bytes());
    }
    content.extend((records.len() as u64).to_le_bytes());
    content.extend(crc32fast::hash(records).to_le_bytes());
    content.extend(text(compression));
    content.extend((compressed.len() as u64).to_le_bytes());
    content.extend(compressed);
    record(op::CHUNK, &content)
}
