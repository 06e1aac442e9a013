//! Chunks: many records, compressed as one.

use std::io::{Cursor, Read};

use mcap::records::ChunkHeader;
use ruzstd::decoding::{FrameDecoder, StreamingDecoder};

use super::framing::{HEAD_BYTES, MOST_RECORD_BYTES, RecordHead};

type Lz4Decoder = lz4_flex::frame::FrameDecoder<Cursor<Vec<u8>>>;

/// The records of the chunk that is being read.
#[derive(Default)]
pub(super) struct Chunk {
    records: Vec<u8>,
    at: usize,
    /// Kept, since its tables and its window are large.
    zstd: FrameDecoder,
    /// Kept for its buffers, unless it failed inside a frame.
    lz4: Option<Lz4Decoder>,
}

/// A record of a chunk: its code, and where its content is.
pub(super) struct ChunkRecord<'a> {
    pub(super) code: u8,
    pub(super) content: &'a [u8],
}

impl Chunk {
    /// Decompresses a chunk in place of the one before.
    ///
    /// # Errors
    /// What is wrong with it; it is then empty.
    pub(super) fn fill(&mut self, header: &ChunkHeader, compressed: &[u8]) -> Result<(), String> {
        self.clear();
        let filled = self.decompressed(header, compressed);
        if filled.is_err() {
            self.clear();
        }
        filled
    }

    fn clear(&mut self) {
        self.records.clear();
        self.at = 0;
    }

    fn decompressed(&mut self, header: &ChunkHeader, compressed: &[u8]) -> Result<(), String> {
        let length = header.uncompressed_size;
        if length > MOST_RECORD_BYTES {
            return Err(format!("it claims {length} bytes, the limit is {MOST_RECORD_BYTES}"));
        }
        // One byte more than it claims shows that there are more, whatever the compressed bytes expand to.
        let most = length + 1;
        match header.compression.as_str() {
            "" => self.records.extend_from_slice(&compressed[..compressed.len().min(index(most))]),
            "zstd" => self.zstd(compressed, most)?,
            "lz4" => self.lz4(compressed, most)?,
            other => {
                let known = "known are zstd, lz4 and none";
                return Err(format!("its compression \"{other}\" is not known, {known}"));
            }
        }
        let found = self.records.len() as u64;
        if found != length {
            let found = if found > length { "more".to_owned() } else { found.to_string() };
            return Err(format!("it claims {length} bytes and has {found}"));
        }
        let sum = header.uncompressed_crc;
        // 0 means that its writer computed none.
        if sum != 0 && crc32fast::hash(&self.records) != sum {
            return Err("its sum is wrong".to_owned());
        }
        Ok(())
    }

    /// All frames of zstd, one behind the other.
    fn zstd(&mut self, compressed: &[u8], most: u64) -> Result<(), String> {
        let mut rest = compressed;
        while !rest.is_empty() && (self.records.len() as u64) < most {
            let left = most - self.records.len() as u64;
            let frame = StreamingDecoder::new_with_decoder(&mut rest, &mut self.zstd);
            let frame = frame.map_err(|fault| fault.to_string())?;
            frame.take(left).read_to_end(&mut self.records).map_err(|fault| fault.to_string())?;
        }
        Ok(())
    }

    fn lz4(&mut self, compressed: &[u8], most: u64) -> Result<(), String> {
        let mut decoder = self.lz4.take().unwrap_or_else(|| Lz4Decoder::new(Cursor::default()));
        let cursor = decoder.get_mut();
        cursor.set_position(0);
        cursor.get_mut().clear();
        cursor.get_mut().extend_from_slice(compressed);
        let read = (&mut decoder).take(most).read_to_end(&mut self.records);
        read.map_err(|fault| fault.to_string())?;
        // At the limit it is inside a frame.
        self.lz4 = Some(decoder).filter(|_| (self.records.len() as u64) < most);
        Ok(())
    }

    /// The next record; `None` after the last.
    ///
    /// # Errors
    /// The rest is no record; nothing more is read of this chunk.
    pub(super) fn next(&mut self) -> Result<Option<ChunkRecord<'_>>, String> {
        let rest = &self.records[self.at..];
        if rest.is_empty() {
            return Ok(None);
        }
        let head = rest.first_chunk::<HEAD_BYTES>().map(|head| RecordHead::read(*head));
        let length = head.map_or(usize::MAX, |head| index(head.length));
        let content = HEAD_BYTES..HEAD_BYTES.saturating_add(length);
        let end = content.end;
        if let (Some(RecordHead { code, .. }), Some(content)) = (head, rest.get(content)) {
            self.at += end;
            return Ok(Some(ChunkRecord { code, content }));
        }
        self.at = self.records.len();
        Err("a record in it is longer than the chunk".to_owned())
    }
}

fn index(length: u64) -> usize {
    usize::try_from(length).unwrap_or(usize::MAX)
}
