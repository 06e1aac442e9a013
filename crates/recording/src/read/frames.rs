//! The frames of a file, from header to header, and which of them are as they were written. Lengths come from the
//! file, so each is compared with the file's size before anything is read or allocated.

use std::{
    io::{self, Read, Seek, SeekFrom},
    ops::Range,
};

use re_log_encoding::{
    Decodable, Encodable, MessageHeader, MessageKind, RRD_FOURCC, StreamFooter, StreamHeader,
};

use crate::rrd::check_sums::{FIELD_AND_SUM, SUM, has_sum, is_intact};

const STREAM_HEADER: usize = StreamHeader::ENCODED_SIZE_BYTES;
const HEADER: usize = MessageHeader::ENCODED_SIZE_BYTES;
const FOOTER: usize = StreamFooter::ENCODED_SIZE_BYTES;
/// Bytes that are searched at once for the next message.
const WINDOW: usize = 1 << 16;

/// What follows the last frame.
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
    /// More after the footer.
    Continued,
}

/// What the check sum of a frame says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sum {
    None,
    Matches,
    Differs,
}

/// The frames of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Frames {
    /// The parts that can be read, each of whole frames; the first begins with the file's header.
    pub(super) readable: Vec<Range<u64>>,
    /// Number of frames with a check sum that matches; `None` if no frame has a check sum.
    pub(super) intact: Option<u64>,
    /// Byte ranges that are not as they were written, or not where they were, each a frame if it still is one.
    pub(super) damaged: Vec<Range<u64>>,
    /// End of the last frame.
    position: u64,
    end: FileEnd,
}

impl Frames {
    /// The frames of a file of `length` bytes. The inner error says why the file is not a recording.
    pub(super) fn read<F: Read + Seek>(file: &mut F, length: u64) -> io::Result<Result<Self, String>> {
        if length < STREAM_HEADER as u64 {
            return Ok(Err(format!("{length} bytes are less than a file header")));
        }
        let mut header = [0; STREAM_HEADER];
        file.read_exact(&mut header)?;
        let version = StreamHeader::from_rrd_bytes(&header).and_then(StreamHeader::to_version_and_options);
        if let Err(error) = version {
            return Ok(Err(error.to_string()));
        }
        let mut reader = FrameReader {
            file,
            length,
            position: STREAM_HEADER as u64,
            before: header.to_vec(),
            frames: vec![(0..STREAM_HEADER as u64, Sum::None)],
            damaged: Vec::new(),
            has_sums: false,
            has_footer: false,
        };
        let end = loop {
            if let Some(end) = reader.next_frame()? {
                break end;
            }
        };
        Ok(Ok(reader.finish(end)))
    }

    /// Whether the file ends with its footer.
    pub(super) fn is_complete(&self) -> bool {
        self.end == FileEnd::Footer
    }

    /// The problem with the end of the file.
    pub(super) fn problem(&self, length: u64) -> Option<String> {
        let position = self.position;
        let read = format!("{} of {length} bytes were read", self.readable.iter().map(bytes).sum::<u64>());
        match self.end {
            FileEnd::Footer => None,
            FileEnd::NoFooter => {
                Some(format!("the file has no footer, so the recording was not finished; {read}"))
            }
            FileEnd::PartialFrame => Some(format!("the file is cut off in the middle of a message; {read}")),
            FileEnd::NotAFrame => Some(format!("the file is damaged after byte {position}; {read}")),
            FileEnd::Continued => Some(format!("the file goes on after the end of its recording; {read}")),
        }
    }
}

fn bytes(range: &Range<u64>) -> u64 {
    range.end - range.start
}

struct FrameReader<'a, F> {
    file: &'a mut F,
    length: u64,
    /// End of the last frame.
    position: u64,
    /// The bytes before it that the check sum of the next frame counts.
    before: Vec<u8>,
    frames: Vec<(Range<u64>, Sum)>,
    damaged: Vec<Range<u64>>,
    /// Whether any frame so far has a check sum: then all must have one.
    has_sums: bool,
    has_footer: bool,
}

impl<F: Read + Seek> FrameReader<'_, F> {
    fn finish(self, end: FileEnd) -> Frames {
        let Self { frames, mut damaged, position, has_sums, .. } = self;
        let (mut readable, mut intact): (Vec<Range<u64>>, u64) = (Vec::new(), 0);
        for (range, sum) in frames {
            intact += u64::from(sum == Sum::Matches);
            // The check sum of the first message counts the file's header, which is needed in any case.
            if sum == Sum::Differs || has_sums && sum == Sum::None && range.start > 0 {
                damaged.push(range);
                continue;
            }
            match readable.last_mut() {
                Some(last) if last.end == range.start => last.end = range.end,
                _ => readable.push(range),
            }
        }
        // `search` finds damage while frames are read; that of wrong sums was added only now, behind it.
        damaged.sort_by_key(|range| range.start);
        Frames { readable, intact: has_sums.then_some(intact), damaged, position, end }
    }

    /// Takes one frame; returns what follows instead if there is none.
    fn next_frame(&mut self) -> io::Result<Option<FileEnd>> {
        // Before anything is read: no bytes after a whole frame are the only regular end.
        if self.position == self.length {
            return Ok(Some(if self.has_footer { FileEnd::Footer } else { FileEnd::NoFooter }));
        }
        // A file with check sums holds one recording. No sum would cover bytes that somebody has appended.
        if self.has_footer && self.has_sums {
            return Ok(Some(FileEnd::Continued));
        }
        let Some(header) = self.read::<HEADER>(self.position)? else {
            return self.search(FileEnd::PartialFrame);
        };
        if header.starts_with(&RRD_FOURCC) {
            // One file can hold several recordings in sequence.
            self.before = header[..STREAM_HEADER].to_vec();
            self.take(self.position + STREAM_HEADER as u64, Sum::None);
            self.has_footer = false;
            return Ok(None);
        }
        let Ok(header) = MessageHeader::from_rrd_bytes(&header) else {
            return self.search(FileEnd::NotAFrame);
        };
        let Some(end) = self.end_of(self.position, header) else { return self.search(FileEnd::PartialFrame) };
        if !self.is_summed(self.position, end)? {
            if self.has_sums {
                // Its length may be wrong, too.
                return self.search(FileEnd::NotAFrame);
            }
            self.take(end, Sum::None);
            return if header.kind == MessageKind::End { self.skip_footer() } else { Ok(None) };
        }
        let message = self.read_all(self.position..end)?;
        let sum = if is_intact(&self.before, &message) { Sum::Matches } else { Sum::Differs };
        self.has_sums = true;
        // The next sum counts this one, so that a message that is missing, moved or repeated breaks the chain.
        self.before = message[message.len() - SUM..].to_vec();
        self.take(end, sum);
        if header.kind == MessageKind::End { self.compare_footer(&message[HEADER..]) } else { Ok(None) }
    }

    fn take(&mut self, end: u64, sum: Sum) {
        self.frames.push((self.position..end, sum));
        self.position = end;
    }

    /// The end of the frame at `start`, if it is in the file.
    fn end_of(&self, start: u64, header: MessageHeader) -> Option<u64> {
        // The length is what the file says: it may overflow, or lead beyond the end.
        start.checked_add(HEADER as u64)?.checked_add(header.len).filter(|&end| end <= self.length)
    }

    /// Whether a frame ends with a check sum.
    fn is_summed(&mut self, start: u64, end: u64) -> io::Result<bool> {
        let at = end.saturating_sub(FIELD_AND_SUM as u64);
        Ok(at >= start + HEADER as u64 && self.read::<FIELD_AND_SUM>(at)?.is_some_and(|tail| has_sum(&tail)))
    }

    /// Skips the footer after the last message; recordings of older versions of rerun have none.
    fn skip_footer(&mut self) -> io::Result<Option<FileEnd>> {
        let Some(footer) = self.read::<FOOTER>(self.position)? else {
            return Ok((self.position != self.length).then_some(FileEnd::PartialFrame));
        };
        // Of any other number of entries rerun's reader takes the length to be right.
        let is_of_one = footer.ends_with(&1_u32.to_le_bytes());
        if is_of_one && StreamFooter::from_rrd_bytes(&footer).is_ok() {
            self.take(self.position + FOOTER as u64, Sum::None);
            self.has_footer = true;
        }
        Ok(None)
    }

    /// Takes the footer of a file with check sums, every byte of which follows from the index before it.
    fn compare_footer(&mut self, index: &[u8]) -> io::Result<Option<FileEnd>> {
        let Some(footer) = self.read::<FOOTER>(self.position)? else {
            return Ok((self.position != self.length).then_some(FileEnd::PartialFrame));
        };
        let mut expected = Vec::new();
        let start = self.position - index.len() as u64;
        let encoded = StreamFooter::from_rrd_footer_bytes(start, index).to_rrd_bytes(&mut expected);
        let is_as_written = encoded.is_ok() && expected == footer;
        self.take(self.position + FOOTER as u64, if is_as_written { Sum::Matches } else { Sum::Differs });
        self.has_footer = true;
        Ok(None)
    }

    /// Goes on at the next message with a check sum; what is before it is damaged. `end` if there is none.
    fn search(&mut self, end: FileEnd) -> io::Result<Option<FileEnd>> {
        let mut window_start = self.position + 1;
        while self.length.saturating_sub(window_start) >= HEADER as u64 {
            let window_end = self.length.min(window_start + WINDOW as u64);
            let window = self.read_all(window_start..window_end)?;
            for (start, header) in (window_start..).zip(window.windows(HEADER)) {
                // Most bytes are not a header; a header begins with the kind, a small number in eight bytes.
                if header[1..8] != [0; 7] {
                    continue;
                }
                let Ok(header) = MessageHeader::from_rrd_bytes(header) else { continue };
                let Some(frame_end) = self.end_of(start, header) else { continue };
                if self.is_summed(start, frame_end)? {
                    self.damaged.push(self.position..start);
                    // The sum before this message is in the last bytes before it, whether or not the message there
                    // is intact.
                    self.before = self.read_all(start.saturating_sub(SUM as u64)..start)?;
                    self.has_sums = true;
                    self.position = start;
                    return Ok(None);
                }
            }
            // Windows overlap by less than a header, so that a header across their border is found, and found once.
            window_start = window_end - (HEADER as u64 - 1);
            if window_end == self.length {
                break;
            }
        }
        Ok(Some(end))
    }

    /// `N` bytes from a place; `None` if the file ends before.
    fn read<const N: usize>(&mut self, at: u64) -> io::Result<Option<[u8; N]>> {
        if self.length - at < N as u64 {
            return Ok(None);
        }
        let mut bytes = [0; N];
        self.file.seek(SeekFrom::Start(at))?;
        self.file.read_exact(&mut bytes)?;
        Ok(Some(bytes))
    }

    /// The bytes of a part of the file.
    fn read_all(&mut self, range: Range<u64>) -> io::Result<Vec<u8>> {
        let length = usize::try_from(bytes(&range)).map_err(|_| io::ErrorKind::OutOfMemory)?;
        let mut bytes = vec![0; length];
        self.file.seek(SeekFrom::Start(range.start))?;
        self.file.read_exact(&mut bytes)?;
        Ok(bytes)
    }
}

/// Byte ranges of a file, read as if there was nothing between them.
pub(super) struct FileParts<F> {
    file: F,
    ranges: std::vec::IntoIter<Range<u64>>,
    /// Bytes of the present range that are not read yet.
    remaining: u64,
}

impl<F> FileParts<F> {
    pub(super) fn new(file: F, ranges: Vec<Range<u64>>) -> Self {
        Self { file, ranges: ranges.into_iter(), remaining: 0 }
    }
}

impl<F: Read + Seek> Read for FileParts<F> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        while self.remaining == 0 {
            let Some(range) = self.ranges.next() else { return Ok(0) };
            self.file.seek(SeekFrom::Start(range.start))?;
            self.remaining = bytes(&range);
        }
        let most = usize::try_from(self.remaining).unwrap_or(usize::MAX).min(buffer.len());
        let count = self.file.read(&mut buffer[..most])?;
        self.remaining = if count == 0 { 0 } else { self.remaining - count as u64 };
        Ok(count)
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;

    fn frames(bytes: &[u8]) -> Result<Frames, String> {
        Frames::read(&mut Cursor::new(bytes), bytes.len() as u64).unwrap()
    }

    #[test]
    fn a_length_beyond_the_file_is_a_cut_not_an_allocation() {
        let mut bytes = b"RRF2\x00\x24\x03\x00\x01\x02\x00\x00".to_vec();
        bytes.extend(1_u64.to_le_bytes());
        bytes.extend(u64::MAX.to_le_bytes());
        let found = frames(&bytes).unwrap();
        assert_eq!((found.position, found.end), (12, FileEnd::PartialFrame));
        assert_eq!((found.readable.len(), found.intact), (1, None));
        assert_eq!(found.readable[0], 0..12);
    }

    #[test]
    fn other_files_are_refused() {
        assert!(frames(b"short").is_err());
        assert!(frames(b"<?xml version=\"1.0\"?>").is_err());
        assert!(frames(b"RRF0\x00\x01\x00\x00\x00\x00\x00\x00").is_err());
    }
}
