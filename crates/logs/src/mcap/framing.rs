//! The records of an MCAP file, one after the other: an operation code, a length, and that many bytes.

use std::{
    fs::File,
    io::{self, BufReader, Read, Seek, SeekFrom},
};

use mcap::{MAGIC, records::op};

/// Most bytes of a record or of a decompressed chunk. Kind: choice; chunks of recorders have 1 to 16 MB.
pub(super) const MOST_RECORD_BYTES: u64 = 256 << 20;
/// Bytes of the code and the length.
pub(super) const HEAD_BYTES: usize = 9;
/// Bytes that are read at once.
const BLOCK_BYTES: usize = 256 << 10;

/// Whether the first bytes of a file are those of an MCAP.
pub(crate) fn is_mcap(head: &[u8]) -> bool {
    head.starts_with(MAGIC)
}

/// The code and the length of a record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct RecordHead {
    pub(super) code: u8,
    pub(super) length: u64,
}

impl RecordHead {
    pub(super) fn read(head: [u8; HEAD_BYTES]) -> Self {
        let [code, length @ ..] = head;
        Self { code, length: u64::from_le_bytes(length) }
    }
}

/// A record in memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct FramedRecord<'a> {
    pub(super) code: u8,
    pub(super) content: &'a [u8],
}

/// The first record of these bytes, and what follows it; `None` if they end inside of it.
pub(super) fn split_record(bytes: &[u8]) -> Option<(FramedRecord<'_>, &[u8])> {
    let (head, rest) = bytes.split_first_chunk::<HEAD_BYTES>()?;
    let RecordHead { code, length } = RecordHead::read(*head);
    let (content, rest) = rest.split_at_checked(usize::try_from(length).ok()?)?;
    Some((FramedRecord { code, content }, rest))
}

/// What comes next in a file.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Framed {
    /// A record with this code, whose content is in the buffer; that of a record that no reader here needs is skipped.
    Record(u8),
    /// The end, between two records.
    End,
    /// The file ends inside the record that begins at this byte.
    Cut(u64),
    /// What begins at this byte is no record.
    NoRecord(u64),
    /// The record that begins at this byte is longer than a record may be. It is skipped.
    TooLong(u64),
}

/// A file that is read record by record.
pub(super) struct Framing {
    file: BufReader<File>,
    /// Bytes before the next record.
    at: u64,
    length: u64,
}

impl Framing {
    /// Starts behind the magic bytes of a file.
    pub(super) fn new(mut file: File) -> io::Result<Self> {
        let length = file.metadata()?.len();
        let at = MAGIC.len() as u64;
        file.seek(SeekFrom::Start(at))?;
        Ok(Self { file: BufReader::with_capacity(BLOCK_BYTES, file), at, length })
    }

    /// Bytes before the next record.
    pub(super) fn at(&self) -> u64 {
        self.at
    }

    /// Goes to another record.
    pub(super) fn go_to(&mut self, at: u64) -> io::Result<()> {
        self.at = at;
        self.file.seek(SeekFrom::Start(at)).map(|_| ())
    }

    /// Reads the next record into `content`.
    pub(super) fn next(&mut self, content: &mut Vec<u8>) -> io::Result<Framed> {
        content.clear();
        let start = self.at;
        let mut head = [0; HEAD_BYTES];
        let found = (&mut self.file).take(HEAD_BYTES as u64).read_to_end(content)?;
        if found < HEAD_BYTES {
            return Ok(if found == 0 { Framed::End } else { Framed::Cut(start) });
        }
        head.copy_from_slice(content);
        content.clear();
        let RecordHead { code, length } = RecordHead::read(head);
        let behind = start + HEAD_BYTES as u64;
        if code == 0 || length > self.length {
            return Ok(Framed::NoRecord(start));
        }
        self.at = behind + length;
        if self.at > self.length {
            return Ok(Framed::Cut(start));
        }
        // Attachments may be larger than the memory.
        if !is_needed(code) || length > MOST_RECORD_BYTES {
            self.file.seek_relative(i64::try_from(length).unwrap_or(i64::MAX))?;
            return Ok(if is_needed(code) { Framed::TooLong(start) } else { Framed::Record(code) });
        }
        (&mut self.file).take(length).read_to_end(content)?;
        // A file that shrinks while it is read.
        let is_whole = content.len() as u64 == length;
        Ok(if is_whole { Framed::Record(code) } else { Framed::Cut(start) })
    }
}

fn is_needed(code: u8) -> bool {
    [op::SCHEMA, op::CHANNEL, op::MESSAGE, op::CHUNK].contains(&code)
}
