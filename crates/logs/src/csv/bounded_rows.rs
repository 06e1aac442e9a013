//! A file whose rows are bounded: without it a missing line end, or a quote that nothing closes, would fill the memory with
//! the rest of the file.

use std::io::{self, Read};

/// Most bytes of a row. Kind: choice; ten thousand columns of numbers with all digits have 200 kB.
const MOST_ROW_BYTES: usize = 1 << 20;

/// Whether a quote begins a cell that may have separators and line ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quoting {
    Used,
    Unused,
}

/// Reads what it is made of, and fails in a row that is too long.
pub(super) struct BoundedRows<R> {
    inner: R,
    quoting: Quoting,
    is_in_quotes: bool,
    row_bytes: usize,
}

impl<R> BoundedRows<R> {
    pub(super) fn new(inner: R, quoting: Quoting) -> Self {
        Self { inner, quoting, is_in_quotes: false, row_bytes: 0 }
    }
}

impl<R: Read> Read for BoundedRows<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.inner.read(buffer)?;
        for byte in &buffer[..count] {
            match byte {
                // A quote that is doubled inside of quotes closes and opens them.
                b'"' if self.quoting == Quoting::Used => self.is_in_quotes = !self.is_in_quotes,
                b'\n' | b'\r' if !self.is_in_quotes => self.row_bytes = 0,
                _ => self.row_bytes += 1,
            }
            if self.row_bytes > MOST_ROW_BYTES {
                return Err(io::Error::other(format!("a row is longer than {MOST_ROW_BYTES} bytes")));
            }
        }
        Ok(count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str, quoting: Quoting) -> io::Result<usize> {
        BoundedRows::new(text.as_bytes(), quoting).read_to_end(&mut Vec::new())
    }

    #[test]
    fn rows_end_at_lines_outside_of_quotes() {
        let rows = "1,2\n".repeat(MOST_ROW_BYTES);
        assert!(read(&rows, Quoting::Used).is_ok());
        let unclosed = format!("1,\"2\n{rows}");
        assert!(read(&unclosed, Quoting::Used).is_err());
        assert!(read(&unclosed, Quoting::Unused).is_ok());
        assert!(read(&"1,".repeat(MOST_ROW_BYTES), Quoting::Unused).is_err());
    }
}
