//! The frames of a file, from header to header without their contents, up to the last complete one. Lengths
//! come from the file, so each is compared with the file's size before anything is read or allocated.

use std::io::{self, Read, Seek, SeekFrom};

use re_log_encoding::{Decodable, MessageHeader, MessageKind, RRD_FOURCC, StreamFooter, StreamHeader};

/// What follows the last complete frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum FileEnd {
    /// Nothing; the last frame is a footer.
    Footer,
    /// Nothing; there is no footer.
    NoFooter,
    /// Part of a frame.
    PartialFrame,
    /// Bytes that are not a frame.
    NotAFrame,
}

/// The part of a file that can be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Extent {
    /// Length of all complete frames, in bytes.
    pub(super) readable: u64,
    end: FileEnd,
}

impl Extent {
    /// The extent of a file of `length` bytes. The inner error says why the file is not a recording.
    pub(super) fn of<F: Read + Seek>(file: &mut F, length: u64) -> io::Result<Result<Self, String>> {
        const HEADER: u64 = StreamHeader::ENCODED_SIZE_BYTES as u64;
        if length < HEADER {
            return Ok(Err(format!("{length} bytes are less than a file header")));
        }
        let mut header = [0; StreamHeader::ENCODED_SIZE_BYTES];
        file.read_exact(&mut header)?;
        let version = StreamHeader::from_rrd_bytes(&header).and_then(StreamHeader::to_version_and_options);
        if let Err(error) = version {
            return Ok(Err(error.to_string()));
        }
        let mut reader = FrameReader { file, length, position: HEADER, has_footer: false };
        let end = loop {
            if let Some(end) = reader.next_frame()? {
                break end;
            }
        };
        Ok(Ok(Self { readable: reader.position, end }))
    }

    /// Whether the file ends with its footer.
    pub(super) fn is_complete(&self) -> bool {
        self.end == FileEnd::Footer
    }

    /// The problem with the end of the file.
    pub(super) fn problem(&self, length: u64) -> Option<String> {
        let read = format!("{} of {length} bytes were read", self.readable);
        match self.end {
            FileEnd::Footer => None,
            FileEnd::NoFooter => {
                Some(format!("the file has no footer, so the recording was not finished; {read}"))
            }
            FileEnd::PartialFrame => Some(format!("the file is cut off in the middle of a message; {read}")),
            FileEnd::NotAFrame => Some(format!("the file is damaged after byte {}; {read}", self.readable)),
        }
    }
}

struct FrameReader<'a, F> {
    file: &'a mut F,
    length: u64,
    /// End of the last complete frame.
    position: u64,
    has_footer: bool,
}

impl<F: Read + Seek> FrameReader<'_, F> {
    /// Skips one frame; returns what follows instead if there is no complete frame.
    fn next_frame(&mut self) -> io::Result<Option<FileEnd>> {
        const HEADER: usize = MessageHeader::ENCODED_SIZE_BYTES;
        if self.position == self.length {
            return Ok(Some(if self.has_footer { FileEnd::Footer } else { FileEnd::NoFooter }));
        }
        let Some(header) = self.read::<HEADER>()? else { return Ok(Some(FileEnd::PartialFrame)) };
        if header.starts_with(&RRD_FOURCC) {
            // One file can hold several recordings in sequence.
            self.position += StreamHeader::ENCODED_SIZE_BYTES as u64;
            self.has_footer = false;
            return Ok(None);
        }
        let Ok(header) = MessageHeader::from_rrd_bytes(&header) else { return Ok(Some(FileEnd::NotAFrame)) };
        let end = self.position.checked_add(HEADER as u64).and_then(|start| start.checked_add(header.len));
        match end {
            Some(end) if end <= self.length => self.position = end,
            _ => return Ok(Some(FileEnd::PartialFrame)),
        }
        if header.kind == MessageKind::End && !self.skip_footer()? {
            return Ok(Some(FileEnd::PartialFrame));
        }
        Ok(None)
    }

    /// Skips the footer after the last message; recordings of older versions of rerun have none.
    fn skip_footer(&mut self) -> io::Result<bool> {
        const FOOTER: usize = StreamFooter::ENCODED_SIZE_BYTES;
        if let Some(footer) = self.read::<FOOTER>()? {
            if StreamFooter::from_rrd_bytes(&footer).is_ok() {
                self.position += FOOTER as u64;
                self.has_footer = true;
            }
            return Ok(true);
        }
        Ok(self.position == self.length)
    }

    /// The next bytes, if there are so many.
    fn read<const N: usize>(&mut self) -> io::Result<Option<[u8; N]>> {
        if self.length - self.position < N as u64 {
            return Ok(None);
        }
        let mut bytes = [0; N];
        self.file.seek(SeekFrom::Start(self.position))?;
        self.file.read_exact(&mut bytes)?;
        Ok(Some(bytes))
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;

    fn extent(bytes: &[u8]) -> Result<Extent, String> {
        Extent::of(&mut Cursor::new(bytes), bytes.len() as u64).unwrap()
    }

    #[test]
    fn a_length_beyond_the_file_is_a_cut_not_an_allocation() {
        let mut bytes = b"RRF2\x00\x24\x03\x00\x01\x02\x00\x00".to_vec();
        bytes.extend(1_u64.to_le_bytes());
        bytes.extend(u64::MAX.to_le_bytes());
        let found = extent(&bytes).unwrap();
        assert_eq!(found, Extent { readable: 12, end: FileEnd::PartialFrame });
    }

    #[test]
    fn other_files_are_refused() {
        assert!(extent(b"short").is_err());
        assert!(extent(b"<?xml version=\"1.0\"?>").is_err());
        assert!(extent(b"RRF0\x00\x01\x00\x00\x00\x00\x00\x00").is_err());
    }
}
