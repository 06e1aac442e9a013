//! Chunks: many records, compressed as one.

use std::io::Read;

use mcap::records::ChunkHeader;
use ruzstd::decoding::{FrameDecoder, StreamingDecoder};

use super::framing::{FramedRecord, MOST_RECORD_BYTES, split_record};

/// The records of the chunk that is being read.
#[derive(Default)]
pub(super) struct Chunk {
    records: Vec<u8>,
    at: usize,
    /// Kept, since its tables and its window are large.
    zstd: FrameDecoder,
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

    /// All frames of lz4. Each chunk has a decoder of its own: one that met a cut frame would go on inside of it.
    fn lz4(&mut self, compressed: &[u8], most: u64) -> Result<(), String> {
        let decoder = lz4_flex::frame::FrameDecoder::new(compressed);
        decoder.take(most).read_to_end(&mut self.records).map(|_| ()).map_err(|fault| fault.to_string())
    }

    /// The next record; `None` after the last.
    ///
    /// # Errors
    /// The rest is no record; nothing more is read of this chunk.
    pub(super) fn next(&mut self) -> Result<Option<FramedRecord<'_>>, String> {
        let rest = &self.records[self.at..];
        if rest.is_empty() {
            return Ok(None);
        }
        let Some((record, rest)) = split_record(rest) else {
            self.at = self.records.len();
            return Err("a record in it is longer than the chunk".to_owned());
        };
        self.at = self.records.len() - rest.len();
        Ok(Some(record))
    }
}

fn index(length: u64) -> usize {
    usize::try_from(length).unwrap_or(usize::MAX)
}
