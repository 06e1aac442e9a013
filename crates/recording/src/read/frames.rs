//! The messages of a file, from header to header. Lengths come from the file, so each is compared with the file's size
//! before anything is read or allocated.

use std::io::{self, Read};

use re_log_encoding::{Decodable, MessageHeader, MessageKind, RRD_FOURCC, StreamFooter, StreamHeader};

const STREAM_HEADER: usize = StreamHeader::ENCODED_SIZE_BYTES;
const HEADER: usize = MessageHeader::ENCODED_SIZE_BYTES;
const FOOTER: usize = StreamFooter::ENCODED_SIZE_BYTES;

/// Why no message follows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum FileEnd {
    /// The file ends with a recording that was finished.
    Complete,
    /// The file ends after a message.
    NotFinished,
    /// The file ends inside a message.
    CutOff,
    /// What follows is none, for this reason.
    Damaged(String),
}

/// The frames of a file: headers, messages and footers.
#[derive(Debug)]
pub(super) struct FileFrames<F> {
    file: F,
    length: u64,
    position: u64,
    is_finished: bool,
}

impl<F: Read> FileFrames<F> {
    /// Begins with a file of `length` bytes. The inner error says why it is not a recording.
    pub(super) fn begin(file: F, length: u64) -> io::Result<Result<Self, String>> {
        let mut frames = Self { file, length, position: 0, is_finished: false };
        let Some(header) = frames.take(STREAM_HEADER as u64)? else {
            return Ok(Err(format!("{length} bytes are less than a file header")));
        };
        let version = StreamHeader::from_rrd_bytes(&header).and_then(StreamHeader::to_version_and_options);
        Ok(version.map(|_| frames).map_err(|error| error.to_string()))
    }

    /// First byte of what was not read yet, from 0.
    pub(super) fn position(&self) -> u64 {
        self.position
    }

    /// The next message with its header; the inner error says why there is none.
    pub(super) fn next_message(&mut self) -> io::Result<Result<Vec<u8>, FileEnd>> {
        loop {
            // Before anything is read: no bytes after a whole frame are the only regular end.
            if self.position == self.length {
                return Ok(Err(if self.is_finished { FileEnd::Complete } else { FileEnd::NotFinished }));
            }
            // The header of a file is shorter than that of a message.
            let Some(mut bytes) = self.take(STREAM_HEADER as u64)? else { return Ok(Err(FileEnd::CutOff)) };
            if bytes.starts_with(&RRD_FOURCC) {
                // One file can hold several recordings in sequence.
                self.is_finished = false;
                continue;
            }
            if self.is_finished {
                let reason = "it goes on after the end of its recording";
                return Ok(Err(FileEnd::Damaged(reason.to_owned())));
            }
            let Some(rest) = self.take((HEADER - STREAM_HEADER) as u64)? else {
                return Ok(Err(FileEnd::CutOff));
            };
            bytes.extend(rest);
            let header = match MessageHeader::from_rrd_bytes(&bytes) {
                Ok(header) => header,
                Err(error) => return Ok(Err(FileEnd::Damaged(error.to_string()))),
            };
            let Some(payload) = self.take(header.len)? else { return Ok(Err(FileEnd::CutOff)) };
            if header.kind != MessageKind::End {
                bytes.extend(payload);
                return Ok(Ok(bytes));
            }
            if let Err(end) = self.footer(&payload)? {
                return Ok(Err(end));
            }
            self.is_finished = true;
        }
    }

    /// Takes the footer that follows an index, which has a check sum of the index.
    fn footer(&mut self, index: &[u8]) -> io::Result<Result<(), FileEnd>> {
        // Older versions of rerun write neither.
        if index.is_empty() {
            return Ok(Ok(()));
        }
        let Some(footer) = self.take(FOOTER as u64)? else { return Ok(Err(FileEnd::CutOff)) };
        // Of any other number of entries rerun's reader takes the length to be right.
        let is_of_one = footer.ends_with(&1_u32.to_le_bytes());
        let footer = is_of_one.then(|| StreamFooter::from_rrd_bytes(&footer).ok()).flatten();
        let sum = footer.map(|footer| footer.entries[0].crc_excluding_header);
        let is_of_index = sum == Some(StreamFooter::compute_crc(index));
        Ok(if is_of_index {
            Ok(())
        } else {
            Err(FileEnd::Damaged("its footer is not that of its index".to_owned()))
        })
    }

    /// The next bytes; `None` if the file ends before.
    fn take(&mut self, count: u64) -> io::Result<Option<Vec<u8>>> {
        let Some(count) =
            usize::try_from(count).ok().filter(|&count| count as u64 <= self.length - self.position)
        else {
            return Ok(None);
        };
        let mut bytes = vec![0; count];
        self.file.read_exact(&mut bytes)?;
        self.position += count as u64;
        Ok(Some(bytes))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frames(bytes: &[u8]) -> Result<FileFrames<&[u8]>, String> {
        FileFrames::begin(bytes, bytes.len() as u64).unwrap()
    }

    #[test]
    fn a_length_beyond_the_file_is_a_cut_not_an_allocation() {
        let mut bytes = b"RRF2\x00\x24\x03\x00\x01\x02\x00\x00".to_vec();
        bytes.extend(1_u64.to_le_bytes());
        bytes.extend(u64::MAX.to_le_bytes());
        assert_eq!(frames(&bytes).unwrap().next_message().unwrap(), Err(FileEnd::CutOff));
    }

    #[test]
    fn other_files_are_refused() {
        assert!(frames(b"short").is_err());
        assert!(frames(b"<?xml version=\"1.0\"?>").is_err());
        assert!(frames(b"RRF0\x00\x01\x00\x00\x00\x00\x00\x00").is_err());
    }
}
