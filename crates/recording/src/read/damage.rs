//! Parts of a file that are not as they were written, and what they held, as far as it can still be decoded.

use std::{
    io::{self, Read, Seek, SeekFrom},
    ops::Range,
};

use congruent_input::{catch_panic, display::quantity};
use re_chunk::Chunk;
use re_log_encoding::{
    CachingApplicationIdInjector, CrateVersion, Decodable, DecoderTransport, Encodable, EncodingOptions,
    MessageHeader, RRD_FOURCC, StreamHeader, ToApplication,
};
use re_log_types::LogMsg;
use schemars::JsonSchema;
use serde::Serialize;

use super::lengths;
use crate::rrd::times::seconds;

/// The most parts of a file that are reported one by one; a corrupt file can have thousands.
pub(super) const MAX_PROBLEMS: usize = 20;
/// The largest part that is looked into.
const MOST_BYTES: u64 = 1 << 26;

/// What the check sums of a recording say.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct CheckSums {
    /// Number of messages that are as they were written; their content is read.
    pub intact: u64,
    /// What is not as it was written, or not where it was; its content is left out.
    pub damaged: Vec<Damage>,
}

/// A part of the file that is not as it was written, or not where it was.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Damage {
    /// Its first byte, from 0.
    pub from_byte: u64,
    /// The first byte after it.
    pub to_byte: u64,
    /// The entity that it is about, if it can still be decoded.
    pub entity: Option<String>,
    /// Its first and last time, likewise.
    pub times_s: Option<[f64; 2]>,
}

impl Damage {
    /// Examines a damaged part of a file: its entity and its times, if they can be decoded.
    pub(super) fn examine<F: Read + Seek>(file: &mut F, range: Range<u64>) -> io::Result<Self> {
        let mut damage = Self { from_byte: range.start, to_byte: range.end, entity: None, times_s: None };
        let mut bytes = Vec::new();
        file.seek(SeekFrom::Start(range.start))?;
        // Bounded: a damaged part may be as long as the file.
        file.take((range.end - range.start).min(MOST_BYTES)).read_to_end(&mut bytes)?;
        // Bytes that cannot be decoded have no entity and no times; the part itself is still reported.
        if let Ok(chunk) = chunk(&bytes) {
            damage.entity = Some(chunk.entity_path().to_string());
            let columns = chunk.timelines().values();
            let ranges =
                columns.filter(|column| column.timeline().typ() == re_log_types::TimeType::DurationNs);
            let mut times = ranges.flat_map(re_chunk::TimeColumn::times_raw);
            damage.times_s = times.next().map(|&first| {
                let (first, last) =
                    times.fold((first, first), |(from, to), &time| (from.min(time), to.max(time)));
                [seconds(first), seconds(last)]
            });
        }
        Ok(damage)
    }

    fn sentence(&self) -> String {
        let times =
            self.times_s.map(|[from, to]| format!(", {} to {}", quantity(from, "s"), quantity(to, "s")));
        let held = self.entity.as_ref().map(|entity| format!(" ({entity}{})", times.unwrap_or_default()));
        format!(
            "bytes {} to {}{} do not match their checksum: they are damaged or were moved within the file, and are skipped",
            self.from_byte,
            self.to_byte,
            held.unwrap_or_default()
        )
    }
}

/// Each damage as a sentence, up to a number.
pub(super) fn problems(damaged: &[Damage]) -> impl Iterator<Item = String> {
    let all = format!("{} parts of the file do not match their check sums in total", damaged.len());
    let more = (damaged.len() > MAX_PROBLEMS).then_some(all);
    damaged.iter().take(MAX_PROBLEMS).map(Damage::sentence).chain(more)
}

/// The chunk in a message.
fn chunk(message: &[u8]) -> Result<Chunk, String> {
    let (stated, payload) = message.split_first_chunk().ok_or("it is shorter than a header")?;
    let stated: &[u8; MessageHeader::ENCODED_SIZE_BYTES] = stated;
    let stated = MessageHeader::from_rrd_bytes(stated).map_err(|error| error.to_string())?;
    // rerun's reader allocates what a header states.
    if stated.len != payload.len() as u64 {
        return Err("it has another length than its header states".to_owned());
    }
    let header = StreamHeader {
        fourcc: RRD_FOURCC,
        version: CrateVersion::LOCAL.to_bytes(),
        options: EncodingOptions::PROTOBUF_COMPRESSED,
    };
    let mut bytes = Vec::new();
    header.to_rrd_bytes(&mut bytes).map_err(|error| error.to_string())?;
    bytes.extend(message);
    // Damaged bytes reach code of rerun that expects its own output, and a panic there must not end the call.
    catch_panic(|| {
        let message = DecoderTransport::decode_lazy(&bytes[..]).next().ok_or("it holds no message")?;
        let message = message.map_err(|error| error.to_string())?;
        lengths::check(&message)?;
        let message = message.to_application((&mut CachingApplicationIdInjector::default(), None));
        match message.map_err(|error| error.to_string())? {
            LogMsg::ArrowMsg(_, message) => {
                Chunk::from_arrow_msg(&message).map_err(|error| error.to_string())
            }
            _ => Err("it holds no chunk".to_owned()),
        }
    })
}
