//! A table whose text is in memory, row by row, with the places of its cells.

use std::ops::Range;

use congruent_input::{Code, Diagnostic, Findings, LineCounter};
use csv::{Reader, ReaderBuilder, StringRecord};

/// Most faults that are listed: one wrong column gives a fault in every row, one wrong header in every column.
pub const MOST_FAULTS: usize = 20;

/// A cell with its place in the text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cell {
    /// What it says, without quotes and without spaces around.
    pub text: String,
    /// Its place.
    pub span: Range<usize>,
}

/// A row that is neither empty nor a comment.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Row {
    /// Line in the text, from 1.
    pub line: usize,
    /// Its place.
    pub span: Range<usize>,
    /// Its cells.
    pub cells: Vec<Cell>,
}

impl Row {
    /// An error about what the row says, with its line and its place.
    #[must_use]
    pub fn mark(&self, fault: Diagnostic) -> Diagnostic {
        Diagnostic {
            message: format!("line {}: {}", self.line, fault.message),
            ..fault.at(self.span.clone())
        }
    }

    /// An error of the whole row.
    pub fn fault(&self, code: &'static Code, message: &str) -> Diagnostic {
        Diagnostic::error(code, format!("line {}: {message}", self.line)).at(self.span.clone())
    }
}

/// The names of the columns.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Header {
    /// The first row.
    pub row: Row,
}

impl Header {
    /// The names, from left to right.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.row.cells.iter().map(|cell| cell.text.as_str())
    }

    /// An error of the cell in column `at`.
    pub fn fault(&self, code: &'static Code, row: &Row, at: usize, message: &str) -> Diagnostic {
        let message = format!("line {}, column \"{}\": {message}", row.line, self.row.cells[at].text);
        Diagnostic::error(code, message).at(row.cells[at].span.clone())
    }

    /// The number in column `at`, `None` if the cell is empty.
    ///
    /// # Errors
    /// The cell is not a finite number.
    pub fn number(&self, code: &'static Code, row: &Row, at: usize) -> Result<Option<f64>, Diagnostic> {
        let written = &row.cells[at].text;
        match written.parse() {
            _ if written.is_empty() => Ok(None),
            Ok(value) if f64::is_finite(value) => Ok(Some(value)),
            _ => Err(self.fault(code, row, at, &format!("\"{written}\" is not a finite number"))),
        }
    }

    /// The number in column `at`.
    ///
    /// # Errors
    /// The cell is empty, or is not a finite number.
    pub fn needed_number(&self, code: &'static Code, row: &Row, at: usize) -> Result<f64, Diagnostic> {
        self.number(code, row, at)?.ok_or_else(|| self.fault(code, row, at, "the cell is empty"))
    }
}

/// A table: its header, and the rows below.
pub struct WrittenTable<'a> {
    /// The first row.
    pub header: Header,
    /// The other rows.
    pub rows: TableRows<'a>,
}

impl<'a> WrittenTable<'a> {
    /// The table in a text, `None` if it has no row at all. A row with another number of cells than the header is an error
    /// with this code.
    pub fn read(text: &'a str, code: &'static Code) -> Option<Self> {
        let reader = reader_builder().has_headers(false).flexible(true).from_reader(text.as_bytes());
        let (record, lines) = (StringRecord::new(), LineCounter::new(text));
        let mut rows = TableRows { text, reader, record, lines, columns: 0, code };
        let row = rows.next_row()?;
        rows.columns = row.cells.len();
        Some(Self { header: Header { row }, rows })
    }
}

/// What to write for the name of a column that is all columns of a table with another separator; `None` if it is one name.
///
/// # Examples
/// ```
/// use congruent_tables::separated_with_commas;
/// let help = separated_with_commas("x_mm;y_mm");
/// assert_eq!(help.as_deref(), Some("separate the columns with commas: x_mm,y_mm"));
/// assert_eq!(separated_with_commas("x_mm"), None);
/// ```
pub fn separated_with_commas(column: &str) -> Option<String> {
    let separator = [';', '\t'].into_iter().find(|separator| column.contains(*separator))?;
    let names: Vec<&str> = column.split(separator).map(str::trim).collect();
    Some(format!("separate the columns with commas: {}", names.join(",")))
}

/// What all CSV files have in common here.
pub(crate) fn reader_builder() -> ReaderBuilder {
    let mut builder = ReaderBuilder::new();
    builder.comment(Some(b'#'));
    builder
}

/// The rows below a header.
pub struct TableRows<'a> {
    text: &'a str,
    reader: Reader<&'a [u8]>,
    record: StringRecord,
    lines: LineCounter<'a>,
    /// Number of cells in the header.
    columns: usize,
    code: &'static Code,
}

impl Iterator for TableRows<'_> {
    type Item = Result<Row, Diagnostic>;

    fn next(&mut self) -> Option<Self::Item> {
        let row = self.next_row()?;
        let (found, expected) = (row.cells.len(), self.columns);
        let fault = || row.fault(self.code, &format!("{found} cells, the header has {expected}"));
        Some(if found == expected { Ok(row) } else { Err(fault()) })
    }
}

impl TableRows<'_> {
    /// Makes a value of each row.
    ///
    /// # Errors
    /// The faults of the first rows that have one.
    pub fn read_each<T>(
        self,
        mut read: impl FnMut(Row) -> Result<T, Diagnostic>,
    ) -> Result<Vec<T>, Findings> {
        let (mut values, mut faults) = (Vec::new(), Vec::new());
        for row in self {
            match row.and_then(&mut read) {
                Ok(value) => values.push(value),
                Err(fault) => faults.push(fault),
            }
            // More of the same would hide the first message.
            if faults.len() >= MOST_FAULTS {
                break;
            }
        }
        if faults.is_empty() { Ok(values) } else { Err(faults.into()) }
    }

    fn next_row(&mut self) -> Option<Row> {
        loop {
            // Text in memory cannot fail to be read, and rows may have any number of cells.
            if !self.reader.read_record(&mut self.record).unwrap_or(false) {
                return None;
            }
            let row = self.row();
            let is_blank = row.cells.len() == 1 && row.cells[0].text.is_empty();
            if !is_blank && !row.cells[0].text.starts_with('#') {
                return Some(row);
            }
        }
    }

    /// The record that was read last, with its places.
    fn row(&mut self) -> Row {
        let offset = |byte: u64| usize::try_from(byte).unwrap_or(usize::MAX).min(self.text.len());
        let start = self.record.position().map_or(0, |position| offset(position.byte()));
        let raw = &self.text[start..offset(self.reader.position().byte())];
        // Comments and blank lines before the record belong to what the reader skipped.
        let skipped: usize = raw
            .split_inclusive('\n')
            .take_while(|line| line.starts_with('#') || line.trim_end_matches(['\r', '\n']).is_empty())
            .map(str::len)
            .sum();
        let start = start + skipped;
        let span = start..start + raw[skipped..].trim_end_matches(['\r', '\n']).len();
        let mut from = start;
        let cells = self.record.iter().map(|contents| {
            let cell = cell(self.text, contents, from..span.end);
            from += cell.1 + 1;
            cell.0
        });
        Row { cells: cells.collect(), line: self.lines.line_column(start).0, span }
    }
}

/// The cell with these contents at the beginning of `place`, and how many bytes of text it has there.
fn cell(text: &str, contents: &str, place: Range<usize>) -> (Cell, usize) {
    let within = |at: usize| text.floor_char_boundary(at.min(place.end));
    let is_quoted = text.as_bytes().get(place.start) == Some(&b'"');
    // Inside quotes a quote is doubled (RFC 4180).
    let length = if is_quoted { contents.len() + 2 + contents.matches('"').count() } else { contents.len() };
    let trimmed = contents.trim();
    let span = if is_quoted {
        within(place.start)..within(place.start + length)
    } else {
        let start = place.start + (contents.len() - contents.trim_start().len());
        within(start)..within(start + trimmed.len())
    };
    // Spreadsheets write spaces before quotes, too.
    (Cell { text: trimmed.trim_matches('"').to_owned(), span }, length)
}
