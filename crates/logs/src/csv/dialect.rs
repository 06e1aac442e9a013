//! How a table is written, by its beginning: separator, names, decimal comma, encoding.

use std::collections::BTreeMap;

use csv::{ByteRecord, ReaderBuilder};

use super::bounded_rows::Quoting;
use crate::{
    table::{CellValue, TableHead, cell_value},
    table_reading::{DecimalMark, Separator, TableEncoding, TableText},
};

/// Rows by which a table is judged. Kind: choice; enough that a first row with missing values decides nothing.
const MOST_ROWS: usize = 200;

/// How a table is written, with its first rows.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Dialect {
    pub(super) text: TableText,
    pub(super) quoting: Quoting,
    /// Number of rows before the first one of numbers: names, units, and lines about the table.
    pub(super) rows_before: usize,
    pub(crate) head: TableHead,
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

/// The cells of a row without an empty one behind the last column: some programs write a separator at the end of each row.
pub(super) fn fitted(mut cells: Vec<String>, width: usize) -> Vec<String> {
    if cells.len() == width + 1 && cells.last().is_some_and(String::is_empty) {
        cells.pop();
    }
    cells
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
    /// Rows before the first one of numbers.
    rows_before: usize,
    width: usize,
    decimal: DecimalMark,
    /// Share of rows of the same width, times that of their cells that are numbers.
    share: f64,
}

/// Why a beginning is not one of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum NoTable {
    /// No separator gives rows with more than one number.
    NoNumbers,
    /// The row before the first numbers has another number of cells.
    Header { names: usize, cells: usize },
}

impl Dialect {
    /// The dialect of a beginning, which ends with a whole row.
    pub(crate) fn of(head: &[u8]) -> Result<Self, NoTable> {
        let encoding = encoding(head);
        let candidates = Separator::ALL.map(|separator| Candidate::new(separator, head, encoding));
        let is_better = |a: &Candidate, b: &Candidate| (a.share, a.width) > (b.share, b.width);
        let tables = candidates.into_iter().filter(|candidate| candidate.width > 1 && candidate.share > 0.0);
        let best = tables.reduce(|best, other| if is_better(&other, &best) { other } else { best });
        let mut best = best.ok_or(NoTable::NoNumbers)?;
        let names = best.take_names()?;
        let without_names = if best.is_open() { best.width - 1 } else { best.width };
        let Candidate { separator, mut rows, rows_before, decimal, .. } = best;
        let names = names.or_else(|| names_in_comment(head, separator, encoding, without_names));
        let width = names.as_ref().map_or(without_names, Vec::len);
        rows = rows.split_off(rows_before).into_iter().map(|row| fitted(row, width)).collect();
        rows.retain(|row| row.len() == width);
        if rows.is_empty() {
            return Err(NoTable::NoNumbers);
        }
        let quoting = quoting(head);
        let text = TableText { separator, decimal, encoding };
        Ok(Self { text, quoting, rows_before, head: TableHead { names, width, rows, decimal } })
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
        let decimal = decimal_mark(&rows, separator);
        let width = usual_width(&rows);
        let numbers = |row: &[String]| numbers(row, decimal);
        let most = rows.iter().filter(|row| row.len() == width).map(|row| numbers(row)).max().unwrap_or(0);
        // A line about the table has few numbers beside its texts; of a row of numbers all but the time may be missing.
        let is_of_numbers = |row: &Vec<String>| {
            let found = numbers(row);
            row.len() == width && found > 0 && (texts(row, decimal) == 0 || 2 * found >= most)
        };
        let rows_before = rows.iter().position(is_of_numbers).unwrap_or(rows.len());
        let data = &rows[rows_before..];
        let whole = data.iter().filter(|row| row.len() == width);
        let (count, found) =
            whole.clone().fold((0, 0), |(count, found), row| (count + row.len(), found + numbers(row)));
        let ratio = |part: usize, of: usize| if of == 0 { 0.0 } else { fraction(part, of) };
        let share = ratio(whole.count(), data.len()) * ratio(found, count);
        Self { separator, rows, rows_before, width, decimal, share }
    }

    /// Whether each row of numbers ends with a separator: then the names may have none behind the last one.
    fn is_open(&self) -> bool {
        let mut data = self.rows[self.rows_before..].iter().filter(|row| row.len() == self.width);
        data.all(|row| row.last().is_some_and(String::is_empty))
    }

    /// The row with the names of the columns: that before the numbers which has the most texts, the first of them if units follow.
    /// Without one before them it is the first row with numbers if it has a text as well.
    fn take_names(&mut self) -> Result<Option<Vec<String>>, NoTable> {
        let (before, data) = self.rows.split_at(self.rows_before);
        let texts = |row: &[String]| texts(row, self.decimal);
        let widths = [Some(self.width), self.width.checked_sub(1).filter(|_| self.is_open())];
        let fitting = before.iter().rev().map(|row| fitted(row.clone(), self.width));
        let fitting = fitting.filter(|row| widths.contains(&Some(row.len())) && texts(row) > 0);
        // The last of several equal ones: they come in reverse.
        if let Some(names) = fitting.max_by_key(|row| texts(row)) {
            return Ok(Some(names));
        }
        if let Some(header) = before.last().filter(|row| texts(row) > 1) {
            return Err(NoTable::Header { names: header.len(), cells: self.width });
        }
        let first = data.first().filter(|row| self.rows_before == 0 && texts(row) > 0).cloned();
        self.rows_before += usize::from(first.is_some());
        Ok(first)
    }
}

/// The number of cells that most rows have. The first row may have names, the last may be cut.
fn usual_width(rows: &[Vec<String>]) -> usize {
    let mut counts = BTreeMap::new();
    let data = rows.get(1..).filter(|rows| !rows.is_empty()).unwrap_or(rows);
    for row in data {
        *counts.entry(row.len()).or_insert(0) += 1;
    }
    counts.into_iter().max_by_key(|(_, count)| *count).map_or(0, |(width, _)| width)
}

/// The mark under which more cells are numbers: a date such as 09.10.2025 is none under either.
fn decimal_mark(rows: &[Vec<String>], separator: Separator) -> DecimalMark {
    let count = |decimal| rows.iter().map(|row| numbers(row, decimal)).sum::<usize>();
    let is_comma = separator != Separator::Comma && count(DecimalMark::Comma) > count(DecimalMark::Point);
    if is_comma { DecimalMark::Comma } else { DecimalMark::Point }
}

/// How many cells of a row are numbers.
fn numbers(row: &[String], decimal: DecimalMark) -> usize {
    row.iter().filter(|cell| matches!(cell_value(cell, decimal), CellValue::Number(_))).count()
}

/// How many cells of a row are neither numbers nor missing.
fn texts(row: &[String], decimal: DecimalMark) -> usize {
    row.iter().filter(|cell| cell_value(cell, decimal) == CellValue::NotANumber).count()
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
            found.head.names.as_ref().map(|names| names.iter().map(String::as_str).collect());
        assert_eq!((found.text.separator, found_names.as_deref()), (separator, names));
        assert_eq!(found.head.rows[0], first);
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
    fn dates_do_not_decide_the_decimal_mark() {
        let rows = "09.10.2025;0,5;1,5\n09.10.2025;1,5;2,5\n";
        let found = Dialect::of(format!("Datum;time_s;q1\n{rows}").as_bytes()).unwrap();
        assert_eq!((found.head.decimal, found.head.names.unwrap().len()), (DecimalMark::Comma, 3));
    }

    #[test]
    fn rows_that_end_with_a_separator() {
        let names = Some(&["t", "q1"][..]);
        for table in ["t,q1\n0,1,\n1,2,\n", "t,q1,\n0,1\n1,2\n", "t,q1\n0,1,\n1,2\n2,3,\n"] {
            check(table, Separator::Comma, names, &["0", "1"]);
        }
    }

    #[test]
    fn rows_that_end_with_a_separator_without_names() {
        check("0,1,\n1,2,\n", Separator::Comma, None, &["0", "1"]);
        // A column whose values are missing has a name.
        check("t,q1,q2\n0,1,\n1,2,\n", Separator::Comma, Some(&["t", "q1", "q2"]), &["0", "1", ""]);
    }

    #[test]
    fn lines_before_the_names_and_units_behind_them() {
        let names = Some(&["t", "q1", "q2"][..]);
        let table = "Robot,UR5e\nRate,125,\nt,q1,q2\ns,rad,rad\n0,1,2\n1,2,3\n";
        check(table, Separator::Comma, names, &["0", "1", "2"]);
        assert_eq!(Dialect::of(table.as_bytes()).unwrap().rows_before, 4);
        let refused = Dialect::of(b"t,q1,q2\n0,1,2,3\n1,2,3,4\n").unwrap_err();
        assert_eq!(refused, NoTable::Header { names: 3, cells: 4 });
    }

    #[test]
    fn a_last_row_that_is_cut_does_not_decide_the_width() {
        let found = Dialect::of(b"t,q1,q2\n0,1,2\n1,2,3\n2,4\n").unwrap();
        assert_eq!((found.head.width, found.head.rows.len()), (3, 2));
    }

    #[test]
    fn decimal_commas_and_latin_1() {
        let table = b"Winkel [\xb0];q\n1,5;2,5\n";
        let found = Dialect::of(table).unwrap();
        assert_eq!((found.text.encoding, found.head.decimal), (TableEncoding::Latin1, DecimalMark::Comma));
        assert_eq!(found.head.names.unwrap()[0], "Winkel [\u{b0}]");
    }

    #[test]
    fn a_text_is_no_table() {
        for text in ["", "one line", "a\nb\n", "# only a comment\n"] {
            assert_eq!(Dialect::of(text.as_bytes()), Err(NoTable::NoNumbers), "{text}");
        }
    }
}
