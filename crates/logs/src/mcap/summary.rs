//! The summary at the end of an MCAP file: where chunks begin, and channels again. It is used if a part of the file before it
//! is damaged.

use std::{
    fs::File,
    io::{self, Read, Seek, SeekFrom},
};

use mcap::{
    MAGIC, parse_record,
    records::{Channel, ChunkIndex, Record, SchemaHeader, op},
};

use super::framing::{FramedRecord, HEAD_BYTES, RecordHead, split_record};

/// Bytes of the footer's content.
const FOOTER_BYTES: usize = 20;
/// Bytes from the footer to the end of the file.
const TAIL_BYTES: u64 = (HEAD_BYTES + FOOTER_BYTES + MAGIC.len()) as u64;
/// Most bytes of a summary that is read. Kind: choice; that of 10 GB has about one.
const MOST_BYTES: u64 = 64 << 20;

/// What a summary says.
#[derive(Default)]
pub(super) struct Summary {
    pub(super) schemas: Vec<SchemaHeader>,
    pub(super) channels: Vec<Channel>,
    /// In the order of their places.
    pub(super) chunks: Vec<ChunkIndex>,
}

impl Summary {
    /// The summary of a file; empty if it has none, or if it is damaged.
    pub(super) fn read(file: &mut File) -> io::Result<Self> {
        let length = file.seek(SeekFrom::End(0))?;
        let Some(footer) = length.checked_sub(TAIL_BYTES) else { return Ok(Self::default()) };
        file.seek(SeekFrom::Start(footer))?;
        let mut tail = Vec::new();
        file.take(TAIL_BYTES).read_to_end(&mut tail)?;
        let Some(start) = summary_start(&tail).filter(|start| *start < footer) else {
            return Ok(Self::default());
        };
        if footer - start > MOST_BYTES {
            return Ok(Self::default());
        }
        file.seek(SeekFrom::Start(start))?;
        let mut bytes = Vec::new();
        file.take(footer - start).read_to_end(&mut bytes)?;
        let mut found = Self::parse(&bytes);
        // A damaged index would lead reading to a place behind the data.
        found.chunks.retain(|chunk| chunk.chunk_start_offset < start);
        Ok(found)
    }

    fn parse(mut rest: &[u8]) -> Self {
        let mut found = Self::default();
        while let Some((FramedRecord { code, content }, behind)) = split_record(rest) {
            rest = behind;
            // Other records are not parsed: the parser believes the lengths that an attachment claims.
            if ![op::SCHEMA, op::CHANNEL, op::CHUNK_INDEX].contains(&code) {
                continue;
            }
            match parse_record(code, content) {
                Ok(Record::Schema { header, .. }) => found.schemas.push(header),
                Ok(Record::Channel(channel)) => found.channels.push(channel),
                Ok(Record::ChunkIndex(chunk)) => found.chunks.push(chunk),
                _ => {}
            }
        }
        found.chunks.sort_by_key(|chunk| chunk.chunk_start_offset);
        found
    }

    /// The first chunk behind a place.
    pub(super) fn chunk_behind(&self, at: u64) -> Option<&ChunkIndex> {
        self.chunks.iter().find(|chunk| chunk.chunk_start_offset > at)
    }

    /// First and last log time of the chunks that begin between two places, or in which the first is.
    pub(super) fn times_between(&self, from: u64, to: u64) -> Option<[u64; 2]> {
        let end = |chunk: &ChunkIndex| chunk.chunk_start_offset.saturating_add(chunk.chunk_length);
        let mut lost = self.chunks.iter().filter(|chunk| end(chunk) > from && chunk.chunk_start_offset < to);
        let first = lost.next()?;
        let mut times = [first.message_start_time, first.message_end_time];
        for chunk in lost {
            times = [times[0].min(chunk.message_start_time), times[1].max(chunk.message_end_time)];
        }
        Some(times)
    }
}

/// Where the summary begins, by the last bytes of a file; `None` if it has none.
fn summary_start(tail: &[u8]) -> Option<u64> {
    let tail = tail.strip_suffix(MAGIC)?;
    let head = RecordHead::read(*tail.first_chunk()?);
    if head != (RecordHead { code: op::FOOTER, length: FOOTER_BYTES as u64 }) {
        return None;
    }
    let start: [u8; 8] = *tail[HEAD_BYTES..].first_chunk()?;
    Some(u64::from_le_bytes(start)).filter(|start| *start != 0)
}
