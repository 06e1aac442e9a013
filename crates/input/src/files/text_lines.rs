//! The text of a large file, read once, line by line. Only the lines that findings show are kept in memory.

use std::{
    io::{BufRead, BufReader, Read, Take},
    ops::Range,
    path::{Path, PathBuf},
    sync::Arc,
};

use sha2::{Digest, Sha256};

use super::{
    access::InputFile,
    open::{decode, open_named, too_large, unreadable, valid_text},
    portable::portable_path,
};
use crate::diagnostic::{Diagnostic, SourceFile};

/// A text of which one line is in memory. [`super::read_text`] refuses the same texts.
pub struct TextLines {
    path: PathBuf,
    from: Take<BufReader<Box<dyn Read>>>,
    most_bytes: u64,
    /// Whether the limit is of each line.
    is_endless: bool,
    is_put_back: bool,
    digest: Sha256,
    line: String,
    /// Lines that were read.
    count: usize,
    /// The kept lines, each in its place; the others are empty.
    kept: String,
    kept_count: usize,
}

impl TextLines {
    /// Opens what a person names: a regular file, a pipe, or `-` for standard input.
    ///
    /// # Errors
    /// It cannot be opened, or is too large.
    pub fn open(path: &Path, most_bytes: u64) -> Result<Self, Diagnostic> {
        Ok(Self {
            path: path.to_owned(),
            from: BufReader::new(open_named(path, most_bytes)?).take(most_bytes.saturating_add(1)),
            most_bytes,
            is_endless: false,
            is_put_back: false,
            digest: Sha256::new(),
            line: String::new(),
            count: 0,
            kept: String::new(),
            kept_count: 0,
        })
    }

    /// The path as given.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Reads on to the next line that is not blank; `false` at the end of the file.
    ///
    /// # Errors
    /// The file cannot be read, is too large, is empty or is no text.
    pub fn advance(&mut self) -> Result<bool, Diagnostic> {
        if std::mem::take(&mut self.is_put_back) {
            return Ok(!self.line.is_empty());
        }
        loop {
            let mut bytes = std::mem::take(&mut self.line).into_bytes();
            bytes.clear();
            if self.is_endless {
                self.from.set_limit(self.most_bytes + 1);
            }
            self.from.read_until(b'\n', &mut bytes).map_err(|error| unreadable(&self.path, &error))?;
            if self.from.limit() == 0 {
                return Err(too_large(&self.path, self.most_bytes + 1, self.most_bytes));
            }
            self.digest.update(&bytes);
            self.line = self.checked(&bytes)?.to_owned();
            self.count += 1;
            if self.line.is_empty() || !self.line.trim().is_empty() {
                return Ok(!self.line.is_empty());
            }
        }
    }

    /// The same for a text that may come for any length of time: each line has at most as many bytes as a file could have.
    #[must_use]
    pub fn of_any_length(mut self) -> Self {
        self.is_endless = true;
        self
    }

    /// Makes the line that was read last the next one again.
    pub fn put_back(&mut self) {
        self.is_put_back = true;
    }

    /// The line that was read last, with its end.
    pub fn line(&self) -> &str {
        &self.line
    }

    /// Keeps the line that was read last. Returns its place, without its end, in the text of [`TextLines::close`].
    pub fn keep(&mut self) -> Range<usize> {
        if self.kept_count < self.count {
            self.kept.extend(std::iter::repeat_n('\n', self.count - 1 - self.kept_count));
            self.kept += &self.line;
            self.kept_count = self.count;
        }
        let start = self.kept.len() - self.line.len();
        start..start + self.line.trim_end().len()
    }

    /// The text so far, of which lines that were not kept are empty.
    pub fn kept(&self) -> Arc<SourceFile> {
        Arc::new(SourceFile { path: self.path.clone(), text: self.kept.clone(), is_foreign: false })
    }

    /// The file with its digest, and all of its text.
    ///
    /// # Errors
    /// As [`TextLines::close`].
    pub fn whole(mut self) -> Result<(InputFile, Arc<SourceFile>), Diagnostic> {
        self.is_endless = false;
        while self.advance()? {
            self.keep();
        }
        self.close()
    }

    /// The file with its digest, and its text, of which lines that were not kept are empty.
    ///
    /// # Errors
    /// What follows cannot be read or is no text.
    pub fn close(mut self) -> Result<(InputFile, Arc<SourceFile>), Diagnostic> {
        while self.advance()? {}
        let Self { path, digest, kept: text, .. } = self;
        let file = portable_path(&path).display().to_string();
        let sha256 = format!("{:x}", digest.finalize());
        Ok((
            InputFile { file, sha256, path: path.clone() },
            Arc::new(SourceFile { path, text, is_foreign: false }),
        ))
    }

    /// A line as text; the first one without its byte order mark.
    fn checked<'a>(&self, bytes: &'a [u8]) -> Result<&'a str, Diagnostic> {
        let text = if self.count == 0 { decode(bytes) } else { valid_text(bytes, self.count) };
        text.map_err(|refused| {
            let (fault, readable) = *refused;
            let text = "\n".repeat(self.count) + readable;
            fault.at(text.len()..text.len()).in_file(&Arc::new(SourceFile {
                path: self.path.clone(),
                text,
                is_foreign: false,
            }))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The lines that are read of such a file, and the text that is kept if every second one is.
    fn read(bytes: &[u8]) -> Result<(Vec<String>, String), Diagnostic> {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), bytes).unwrap();
        let (mut lines, mut read) = (TextLines::open(file.path(), 100)?, Vec::new());
        while lines.advance()? {
            read.push(lines.line().to_owned());
            if read.len().is_multiple_of(2) {
                let place = lines.keep();
                assert_eq!((lines.keep(), &lines.kept[place.clone()]), (place, lines.line().trim_end()));
            }
        }
        let (input, source) = lines.close()?;
        assert_eq!(input.sha256, format!("{:x}", Sha256::digest(bytes)));
        Ok((read, source.text.clone()))
    }

    #[test]
    fn kept_lines_are_in_their_places() {
        let (lines, kept) = read("\u{feff}a\r\n\n \nbé\r\nc\nd".as_bytes()).unwrap();
        assert_eq!((lines.concat().as_str(), kept.as_str()), ("a\r\nbé\r\nc\nd", "\n\n\nbé\r\n\nd"));
        assert_eq!(read(b"\xEF\xBB\xBF").unwrap(), (vec![], String::new()));
    }

    #[test]
    fn a_text_that_is_refused_is_refused_with_its_place() {
        let fault = |bytes: &[u8]| {
            let fault = read(bytes).unwrap_err();
            (fault.code.name, fault.line_column())
        };
        assert_eq!(fault(b""), ("file::empty", Some((1, 1))));
        assert_eq!(fault(b"\xFF\xFEa"), ("file::utf16", Some((1, 1))));
        assert_eq!(fault(b"a\n\nb\xE9"), ("file::not_utf8", Some((3, 2))));
        assert_eq!(fault(b"a\nbc\0"), ("file::nul", Some((2, 3))));
        assert_eq!(fault(&[b'a'; 101]), ("file::too_large", None));
    }
}
