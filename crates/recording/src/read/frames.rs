//! How far a file goes: its frames, from header to header, without looking inside. Lengths come
//! from the file, so each is held against what is there before anything is read or allocated.

use std::io::{self, Read, Seek, SeekFrom};

use re_log_encoding::{Decodable, MessageHeader, MessageKind, RRD_FOURCC, StreamFooter, StreamHeader};

/// What was found at the end of the last whole frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum End {
    /// A footer, and nothing behind it.
    Footer,
    /// The end of the file.
    Nothing,
    /// A frame of which a part is missing.
    HalfFrame,
    /// Bytes that are no frame.
    Garbage,
}

/// The part of a file that can be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Extent {
    /// Length of all whole frames.
    pub(super) readable: u64,
    end: End,
}

impl Extent {
    /// Walks over a file of `length` bytes. The inner error says why it is no recording.
    pub(super) fn of<F: Read + Seek>(file: &mut F, length: u64) -> io::Result<Result<Self, String>> {
        const HEADER: u64 = StreamHeader::ENCODED_SIZE_BYTES as u64;
        if length < HEADER {
            return Ok(Err(format!("{length} bytes are too few")));
        }
        let mut header = [0; StreamHeader::ENCODED_SIZE_BYTES];
        file.read_exact(&mut header)?;
        let version = StreamHeader::from_rrd_bytes(&header).and_then(StreamHeader::to_version_and_options);
        if let Err(error) = version {
            return Ok(Err(error.to_string()));
        }
        let mut walk = Walk { file, length, position: HEADER, has_footer: false };
        let end = loop {
            if let Some(end) = walk.next_frame()? {
                break end;
            }
        };
        Ok(Ok(Self { readable: walk.position, end }))
    }

    /// Whether the file ends as it should.
    pub(super) fn is_whole(&self) -> bool {
        self.end == End::Footer
    }

    /// What is wrong with the end of the file.
    pub(super) fn problem(&self, length: u64) -> Option<String> {
        let read = format!("{} of {length} bytes were read", self.readable);
        match self.end {
            End::Footer => None,
            End::Nothing => Some(format!("there is no footer: the recording was not finished; {read}")),
            End::HalfFrame => Some(format!("the file is cut off in the middle of a message; {read}")),
            End::Garbage => Some(format!("the file is damaged behind byte {}; {read}", self.readable)),
        }
    }
}

struct Walk<'a, F> {
    file: &'a mut F,
    length: u64,
    /// End of the last whole frame.
    position: u64,
    has_footer: bool,
}

impl<F: Read + Seek> Walk<'_, F> {
    /// Steps over one frame; gives the end where there is none.
    fn next_frame(&mut self) -> io::Result<Option<End>> {
        const HEADER: usize = MessageHeader::ENCODED_SIZE_BYTES;
        if self.position == self.length {
            return Ok(Some(if self.has_footer { End::Footer } else { End::Nothing }));
        }
        let Some(header) = self.read::<HEADER>()? else { return Ok(Some(End::HalfFrame)) };
        if header.starts_with(&RRD_FOURCC) {
            // Recordings may stand one behind another in one file.
            self.position += StreamHeader::ENCODED_SIZE_BYTES as u64;
            self.has_footer = false;
            return Ok(None);
        }
        let Ok(header) = MessageHeader::from_rrd_bytes(&header) else { return Ok(Some(End::Garbage)) };
        let end = self.position.checked_add(HEADER as u64).and_then(|start| start.checked_add(header.len));
        match end {
            Some(end) if end <= self.length => self.position = end,
            _ => return Ok(Some(End::HalfFrame)),
        }
        if header.kind == MessageKind::End && !self.skip_footer()? {
            return Ok(Some(End::HalfFrame));
        }
        Ok(None)
    }

    /// The footer behind the last message; recordings of old programs have none.
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

    /// The next bytes, where there are so many.
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
        assert_eq!(found, Extent { readable: 12, end: End::HalfFrame });
    }

    #[test]
    fn other_files_are_refused() {
        assert!(extent(b"short").is_err());
        assert!(extent(b"<?xml version=\"1.0\"?>").is_err());
        assert!(extent(b"RRF0\x00\x01\x00\x00\x00\x00\x00\x00").is_err());
    }
}
