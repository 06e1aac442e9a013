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

/// Where in a row a byte is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum PlaceInRow {
    RowStart,
    CellStart,
    Cell,
    InQuotes,
    Comment,
}

/// Reads what it is made of, and fails in a row that is too long.
pub(super) struct BoundedRows<R> {
    inner: R,
    quoting: Quoting,
    separator: u8,
    place: PlaceInRow,
    row_bytes: usize,
}

impl<R> BoundedRows<R> {
    pub(super) fn new(inner: R, quoting: Quoting, separator: u8) -> Self {
        Self { inner, quoting, separator, place: PlaceInRow::RowStart, row_bytes: 0 }
    }

    /// The place behind a byte, as the parser of the table sees it: a quote has a meaning at the start of a cell alone.
    fn behind(&self, byte: u8) -> PlaceInRow {
        match (self.place, byte) {
            // A quote that is doubled ends the cell and begins it again.
            (PlaceInRow::InQuotes, b'"') => PlaceInRow::CellStart,
            (PlaceInRow::InQuotes, _) => PlaceInRow::InQuotes,
            (_, b'\n') => PlaceInRow::RowStart,
            (PlaceInRow::Comment, _) | (PlaceInRow::RowStart, b'#') => PlaceInRow::Comment,
            (_, b'\r') => PlaceInRow::RowStart,
            (PlaceInRow::RowStart | PlaceInRow::CellStart, b'"') if self.quoting == Quoting::Used => {
                PlaceInRow::InQuotes
            }
            (_, byte) if byte == self.separator => PlaceInRow::CellStart,
            _ => PlaceInRow::Cell,
        }
    }
}

impl<R: Read> Read for BoundedRows<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.inner.read(buffer)?;
        for byte in &buffer[..count] {
            self.place = self.behind(*byte);
            self.row_bytes = if self.place == PlaceInRow::RowStart { 0 } else { self.row_bytes + 1 };
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
        BoundedRows::new(text.as_bytes(), quoting, b',').read_to_end(&mut Vec::new())
    }

    #[test]
    fn rows_end_at_lines_outside_of_quotes() {
        let rows = "1,2\n".repeat(MOST_ROW_BYTES);
        assert!(read(&rows, Quoting::Used).is_ok());
        let unclosed = format!("1,\"2\n{rows}");
        assert!(read(&unclosed, Quoting::Used).is_err());
        assert!(read(&unclosed, Quoting::Unused).is_ok());
        for early in ["1,5\" drive\n", "# 5\" drive\n"] {
            assert!(read(&format!("{early}{rows}"), Quoting::Used).is_ok(), "{early}");
        }
        assert!(read(&"1,".repeat(MOST_ROW_BYTES), Quoting::Unused).is_err());
    }
}
