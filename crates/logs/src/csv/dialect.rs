//! How a table is written, by its beginning: separator, names, decimal comma, encoding.

use csv::{ByteRecord, ReaderBuilder};

use super::{
    bounded_rows::Quoting,
    number::{CellValue, cell_value},
};
use crate::table_reading::{DecimalMark, Separator, TableEncoding};

/// Rows by which a table is judged. Kind: choice; enough that a first row with missing values decides nothing.
const MOST_ROWS: usize = 200;

/// How a table is written, with its first rows.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Dialect {
    pub(super) separator: Separator,
    pub(super) encoding: TableEncoding,
    pub(super) decimal: DecimalMark,
    pub(super) quoting: Quoting,
    /// The names of the columns; `None` without names.
    pub(super) names: Option<Vec<String>>,
    /// Whether the names are the first row; if not, they are in a comment before it.
    pub(super) are_names_a_row: bool,
    /// Number of cells of a row.
    pub(super) width: usize,
    /// The first rows of numbers.
    pub(super) rows: Vec<Vec<String>>,
}

impl Separator {
    const ALL: [Self; 4] = [Self::Comma, Self::Semicolon, Self::Tab, Self::Blanks];

    pub(super) fn byte(self) -> u8 {
        match self {
            Self::Comma => b',',
            Self::Semicolon => b';',
            Self::Tab => b'\t',
            Self::Blanks => b' ',
        }
    }

    /// What all readers of a table with this separator have in common.
    pub(super) fn reader_builder(self, quoting: Quoting) -> ReaderBuilder {
        let mut builder = ReaderBuilder::new();
        builder.quoting(quoting == Quoting::Used);
        builder.delimiter(self.byte()).comment(Some(b'#')).has_headers(false).flexible(true);
        builder
    }

    /// The cells of a row, as text. Between blanks no cell is empty.
    pub(super) fn cells(self, row: &ByteRecord, encoding: TableEncoding) -> Vec<String> {
        let is_kept = |cell: &&[u8]| self != Self::Blanks || !cell.is_empty();
        row.iter().filter(is_kept).map(|cell| decoded(cell, encoding)).collect()
    }
}

/// Text of these bytes.
fn decoded(bytes: &[u8], encoding: TableEncoding) -> String {
    let text = match encoding {
        TableEncoding::Utf8 => String::from_utf8_lossy(bytes).into_owned(),
        TableEncoding::Latin1 => bytes.iter().map(|&byte| char::from(byte)).collect(),
    };
    text.trim().trim_start_matches('\u{feff}').to_owned()
}

/// A separator under which the beginning has been read.
struct Candidate {
    separator: Separator,
    rows: Vec<Vec<String>>,
    width: usize,
    decimal: DecimalMark,
    /// Share of rows of the same width, times that of their cells that are numbers.
    share: f64,
}

impl Dialect {
    /// The dialect of a beginning, which ends with a whole row; `None` if no separator gives two numbers in a row.
    pub(super) fn of(head: &[u8]) -> Option<Self> {
        let encoding = encoding(head);
        let candidates = Separator::ALL.map(|separator| Candidate::new(separator, head, encoding));
        let is_better = |a: &Candidate, b: &Candidate| (a.share, a.width) > (b.share, b.width);
        let tables = candidates.into_iter().filter(|candidate| candidate.width > 1 && candidate.share > 0.0);
        let best = tables.reduce(|best, other| if is_better(&other, &best) { other } else { best })?;
        let Candidate { separator, mut rows, width, decimal, .. } = best;
        let value = |cell: &String| cell_value(cell, decimal);
        let has_names = rows.first()?.iter().any(|cell| value(cell) == CellValue::NotANumber);
        let names = if has_names { Some(rows.remove(0)) } else { None };
        let names = names.or_else(|| names_in_comment(head, separator, encoding, width));
        let width = names.as_ref().map_or(width, Vec::len);
        rows.retain(|row| row.len() == width);
        Some(Self {
            separator,
            encoding,
            decimal,
            quoting: quoting(head),
            names,
            are_names_a_row: has_names,
            width,
            rows,
        })
    }

    /// The name of a column, or its number from 1.
    pub(super) fn name(&self, column: usize) -> String {
        let name = self.names.as_ref().and_then(|names| names.get(column));
        name.cloned().unwrap_or_else(|| format!("column {}", column + 1))
    }
}

impl Candidate {
    fn new(separator: Separator, head: &[u8], encoding: TableEncoding) -> Self {
        let mut reader = separator.reader_builder(quoting(head)).from_reader(head);
        let (mut rows, mut record) = (Vec::new(), ByteRecord::new());
        while rows.len() < MOST_ROWS && reader.read_byte_record(&mut record).unwrap_or(false) {
            let cells = separator.cells(&record, encoding);
            if cells.iter().any(|cell| !cell.is_empty()) {
                rows.push(cells);
            }
        }
        let width = rows.last().map_or(0, Vec::len);
        // The first row may have names.
        let data = rows.get(1..).filter(|rows| !rows.is_empty()).unwrap_or(&rows);
        let points = data.iter().flatten().any(|cell| cell.contains('.'));
        let commas = separator != Separator::Comma && data.iter().flatten().any(|cell| cell.contains(','));
        let decimal = if commas && !points { DecimalMark::Comma } else { DecimalMark::Point };
        let is_number = |cell: &&String| matches!(cell_value(cell, decimal), CellValue::Number(_));
        let whole = data.iter().filter(|row| row.len() == width);
        let (count, numbers) = whole.clone().fold((0, 0), |(count, numbers), row| {
            (count + row.len(), numbers + row.iter().filter(is_number).count())
        });
        let ratio = |part: usize, of: usize| if of == 0 { 0.0 } else { fraction(part, of) };
        let share = ratio(whole.count(), data.len()) * ratio(numbers, count);
        Self { separator, rows, width, decimal, share }
    }
}

#[expect(clippy::cast_precision_loss, reason = "counts of the beginning of a file")]
fn fraction(part: usize, of: usize) -> f64 {
    part as f64 / of as f64
}

/// Names in the last comment before the first row, as numpy writes them.
fn names_in_comment(
    head: &[u8],
    separator: Separator,
    encoding: TableEncoding,
    width: usize,
) -> Option<Vec<String>> {
    let lines = head.split(|byte| *byte == b'\n').take_while(|line| line.starts_with(b"#"));
    let line = lines.last()?.trim_ascii_start();
    let line = line.strip_prefix(b"#")?;
    let mut record = ByteRecord::new();
    separator
        .reader_builder(Quoting::Used)
        .comment(None)
        .from_reader(line)
        .read_byte_record(&mut record)
        .ok()?;
    let names = separator.cells(&record, encoding);
    let is_name = |name: &String| cell_value(name, DecimalMark::Point) == CellValue::NotANumber;
    (names.len() == width && names.iter().all(is_name)).then_some(names)
}

/// Quotes are ordinary characters in a table whose beginning has none: one that is not closed would take the rest of the table.
fn quoting(head: &[u8]) -> Quoting {
    if head.contains(&b'"') { Quoting::Used } else { Quoting::Unused }
}

/// UTF-8 if the bytes are, except for a character that is cut at the end.
fn encoding(head: &[u8]) -> TableEncoding {
    match std::str::from_utf8(head) {
        Err(fault) if fault.error_len().is_some() => TableEncoding::Latin1,
        _ => TableEncoding::Utf8,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(head: &str, separator: Separator, names: Option<&[&str]>, first: &[&str]) {
        let found = Dialect::of(head.as_bytes()).unwrap();
        let found_names: Option<Vec<&str>> =
            found.names.as_ref().map(|names| names.iter().map(String::as_str).collect());
        assert_eq!((found.separator, found_names.as_deref()), (separator, names));
        assert_eq!(found.rows[0], first);
    }

    #[test]
    fn separators_with_and_without_names() {
        check("t,q1\n0,1.5\n1,2.5\n", Separator::Comma, Some(&["t", "q1"]), &["0", "1.5"]);
        check("t;q1\n0;1,5\n1;2,5\n", Separator::Semicolon, Some(&["t", "q1"]), &["0", "1,5"]);
        check("0\t1.5\n1\t2.5\n", Separator::Tab, None, &["0", "1.5"]);
        check("t  q1\n 0   1.5\n 1 2.5\n", Separator::Blanks, Some(&["t", "q1"]), &["0", "1.5"]);
        check("# t q1\n0 1.5\n1 2.5\n", Separator::Blanks, Some(&["t", "q1"]), &["0", "1.5"]);
        check("1.0, 2.0\n3.0, 4.0\n", Separator::Comma, None, &["1.0", "2.0"]);
        check("\u{feff}t,q1\r\n0,\r\n1,2\r\n", Separator::Comma, Some(&["t", "q1"]), &["0", ""]);
    }

    #[test]
    fn decimal_commas_and_latin_1() {
        let table = b"Winkel [\xb0];q\n1,5;2,5\n";
        let found = Dialect::of(table).unwrap();
        assert_eq!((found.encoding, found.decimal), (TableEncoding::Latin1, DecimalMark::Comma));
        assert_eq!(found.names.unwrap()[0], "Winkel [\u{b0}]");
    }

    #[test]
    fn a_text_is_no_table() {
        for text in ["", "one line", "a\nb\n", "# only a comment\n"] {
            assert_eq!(Dialect::of(text.as_bytes()), None, "{text}");
        }
    }
}
