//! The text of a large file, read once from its beginning to its end. Only the lines that findings show are kept in memory.

use std::{
    io::{self, Read},
    ops::Range,
    path::{Path, PathBuf},
    sync::Arc,
};

use sha2::{Digest, Sha256};

use super::{
    access::InputFile,
    open::{not_utf8, nul, open_named, too_large, unreadable, without_mark},
};
use crate::diagnostic::{Diagnostic, SourceFile};

/// Bytes that are read at once.
const PIECE: usize = 64 << 10;
/// Bytes that are kept on either side of what a finding is about: more than snippets show. A line that is longer has none.
const AROUND: usize = 1 << 10;

/// A text that is read piece by piece: what [`super::read_text`] refuses of it is the fault with which reading ends.
pub struct TextStream {
    path: PathBuf,
    from: Box<dyn Read>,
    most_bytes: u64,
    /// Bytes that were taken from the file, with the byte order mark.
    length: u64,
    digest: Sha256,
    /// The text around the reader: first what findings may show, then what comes next.
    window: Vec<u8>,
    window_start: TextPlace,
    /// Of the window: what was read, and the end of what is known to be UTF-8.
    read: usize,
    known: usize,
    is_at_end: bool,
    fault: Option<Diagnostic>,
    excerpts: Excerpts,
}

/// A place in a text.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
struct TextPlace {
    offset: usize,
    /// Number of lines before the place.
    line: usize,
    /// Characters and bytes of its line before it.
    column: usize,
    column_bytes: usize,
}

impl TextPlace {
    /// The place after these bytes.
    fn after(self, bytes: &[u8]) -> Self {
        let line_start = bytes.iter().rposition(|&byte| byte == b'\n').map(|at| at + 1);
        let in_line = &bytes[line_start.unwrap_or(0)..];
        let characters = in_line.iter().filter(|&&byte| is_first_of_character(byte)).count();
        let (column, column_bytes) = line_start.map_or((self.column, self.column_bytes), |_| (0, 0));
        Self {
            offset: self.offset + bytes.len(),
            line: self.line + bytes.split(|&byte| byte == b'\n').count() - 1,
            column: column + characters,
            column_bytes: column_bytes + in_line.len(),
        }
    }
}

fn is_first_of_character(byte: u8) -> bool {
    byte & 0xC0 != 0x80
}

/// A text with the lines and columns of another, of which it has parts alone; the rest is empty lines and spaces.
#[derive(Debug, Default)]
struct Excerpts {
    text: String,
    /// Where the text ends, in itself and in the other one.
    end: TextPlace,
}

impl Excerpts {
    /// Adds a part, of which the text may have the beginning already.
    fn keep(&mut self, part: &[u8], start: TextPlace) {
        let known = self.end.offset.saturating_sub(start.offset).min(part.len());
        let (start, part) = (start.after(&part[..known]), &part[known..]);
        if part.is_empty() {
            return;
        }
        if start.line > self.end.line {
            self.text.extend(std::iter::repeat_n('\n', start.line - self.end.line));
            self.end.column = 0;
        }
        self.text.extend(std::iter::repeat_n(' ', start.column - self.end.column));
        self.text += &String::from_utf8_lossy(part);
        self.end = start.after(part);
    }

    /// The offset in the excerpts of an offset of the whole text that lies in the last part.
    fn find(&self, offset: usize) -> usize {
        self.text.len().saturating_sub(self.end.offset.saturating_sub(offset))
    }
}

impl TextStream {
    /// Opens what a person names: a regular file, a pipe, or `-` for standard input.
    ///
    /// # Errors
    /// It cannot be opened, is too large, is empty or is no text.
    pub fn open(path: &Path, most_bytes: u64) -> Result<Self, Diagnostic> {
        let mut stream = Self {
            path: path.to_owned(),
            from: open_named(path, most_bytes)?,
            most_bytes,
            length: 0,
            digest: Sha256::new(),
            window: Vec::new(),
            window_start: TextPlace::default(),
            read: 0,
            known: 0,
            is_at_end: false,
            fault: None,
            excerpts: Excerpts::default(),
        };
        stream.fill();
        match stream.fault {
            Some(fault) => Err(placed(fault, &stream.excerpts.into_source(stream.path))),
            None => Ok(stream),
        }
    }

    /// Bytes of the text that were read.
    pub fn offset(&self) -> usize {
        self.window_start.offset + self.read
    }

    /// The byte before [`TextStream::offset`].
    pub fn last(&self) -> Option<u8> {
        self.window[..self.read].last().copied()
    }

    /// Forgets the text that was read, except the last bytes, which a finding about the following text may show.
    pub fn forget(&mut self) {
        let mut end = self.read.saturating_sub(AROUND);
        // Only in large steps, since each one moves the rest of the window in memory.
        if end < PIECE {
            return;
        }
        while end > 0 && !is_first_of_character(self.window[end]) {
            end -= 1;
        }
        self.window_start = self.window_start.after(&self.window[..end]);
        self.window.drain(..end);
        self.read -= end;
        self.known -= end;
    }

    /// Keeps a range that was not forgotten, with what is around it; its place in the text that [`TextStream::close`] gives.
    pub fn keep(&mut self, range: Range<usize>) -> Range<usize> {
        self.look_ahead();
        let inside = |offset: usize| offset.saturating_sub(self.window_start.offset).min(self.known);
        let character = |mut at: usize| {
            while at > 0 && at < self.known && !is_first_of_character(self.window[at]) {
                at -= 1;
            }
            at
        };
        let start = character(inside(range.start).saturating_sub(AROUND));
        let end = character((inside(range.end) + AROUND).min(self.known));
        let place = self.window_start.after(&self.window[..start]);
        self.excerpts.keep(&self.window[start..end], place);
        self.excerpts.find(range.start)..self.excerpts.find(range.end)
    }

    /// The offset of a line and a column in bytes, both from 1, in what was not forgotten.
    pub fn offset_of(&self, line: usize, column: usize) -> usize {
        let mut at = TextPlace { line: self.window_start.line + 1, ..self.window_start };
        let mut lines = self.window[..self.known].split_inclusive(|&byte| byte == b'\n');
        while at.line < line
            && let Some(passed) = lines.next()
        {
            at = TextPlace { offset: at.offset + passed.len(), line: at.line + 1, ..TextPlace::default() };
        }
        let in_line = column.saturating_sub(1).saturating_sub(at.column_bytes);
        (at.offset + in_line).min(self.window_start.offset + self.known)
    }

    /// Reads the rest of the file. Returns the file with its digest, and the kept excerpts of its text.
    ///
    /// # Errors
    /// The file cannot be read to its end or is no text.
    pub fn close(mut self) -> Result<(InputFile, Arc<SourceFile>), Diagnostic> {
        while self.fault.is_none() && !self.is_at_end {
            self.read = self.known;
            self.forget();
            self.fill();
        }
        let Self { path, fault, excerpts, .. } = self;
        let source = excerpts.into_source(path.clone());
        if let Some(fault) = fault {
            return Err(placed(fault, &source));
        }
        let sha256 = format!("{:x}", self.digest.finalize());
        Ok((InputFile { file: path.display().to_string(), sha256, path }, source))
    }

    /// Reads on until the text after the reader's place can be kept, too.
    fn look_ahead(&mut self) {
        while self.known - self.read < AROUND && !self.is_at_end && self.fault.is_none() {
            self.fill();
        }
    }

    /// Adds a piece to the window.
    fn fill(&mut self) {
        let (is_first, before) = (self.length == 0, self.window.len());
        let most = (PIECE as u64).min(self.most_bytes + 1 - self.length);
        if let Err(error) = (&mut self.from).take(most).read_to_end(&mut self.window) {
            self.fault = Some(unreadable(&self.path, &error));
            return;
        }
        let added = (self.window.len() - before) as u64;
        self.length += added;
        self.is_at_end = added < most;
        if self.length > self.most_bytes {
            self.fault = Some(too_large(&self.path, self.length, self.most_bytes));
            return;
        }
        self.digest.update(&self.window[before..]);
        if is_first {
            match without_mark(&self.window).map(<[u8]>::len) {
                Ok(length) => drop(self.window.drain(..self.window.len() - length)),
                Err(fault) => self.fault = Some(fault.at(0..0)),
            }
        }
        if self.fault.is_none() {
            self.check();
        }
    }

    /// Checks that the new bytes of the window are UTF-8 without NUL.
    fn check(&mut self) {
        let new = &self.window[self.known..];
        let (good, bad) = match std::str::from_utf8(new) {
            Ok(_) => (new.len(), None),
            Err(error) => {
                // A character may go on in the next piece.
                let is_bad = self.is_at_end || error.error_len().is_some();
                (error.valid_up_to(), new.get(error.valid_up_to()).filter(|_| is_bad).copied())
            }
        };
        let end = new[..good].iter().position(|&byte| byte == 0);
        self.known += end.unwrap_or(good);
        let line = || self.window_start.after(&self.window[..self.known]).line + 1;
        let fault = match (end, bad) {
            (Some(_), _) => nul(line()),
            (None, Some(byte)) => not_utf8(byte, line()),
            (None, None) => return,
        };
        self.is_at_end = true;
        let at = self.window_start.offset + self.known;
        let span = self.keep(at..at);
        self.fault = Some(fault.at(span));
    }
}

/// The fault with its text, unless it is about the file as a whole.
fn placed(fault: Diagnostic, source: &Arc<SourceFile>) -> Diagnostic {
    if fault.span.is_some() { fault.in_file(source) } else { fault }
}

impl Excerpts {
    fn into_source(self, path: PathBuf) -> Arc<SourceFile> {
        Arc::new(SourceFile { path, text: self.text })
    }
}

impl Read for TextStream {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        while self.read == self.known && !self.is_at_end && self.fault.is_none() {
            self.fill();
        }
        if self.read == self.known && self.fault.is_some() {
            return Err(io::ErrorKind::InvalidData.into());
        }
        let next = &self.window[self.read..self.known];
        let count = next.len().min(bytes.len());
        bytes[..count].copy_from_slice(&next[..count]);
        self.read += count;
        Ok(count)
    }
}
