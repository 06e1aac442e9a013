//! The rows of a text.

use std::{
    fs::File,
    io::{Read, Seek, SeekFrom},
    path::Path,
    sync::Arc,
};

use congruent_input::{Code, Diagnostic, SourceFile, display::counted, open_regular, unreadable};
use csv::{ByteRecord, Reader};

use super::{
    bounded_rows::BoundedRows,
    dialect::{Dialect, NoTable, fitted},
};
use crate::{
    codes,
    event::LogFormat,
    table::{OpenTable, RowSource, TableRow},
    table_reading::{Separator, TableEncoding},
};

/// Bytes of the beginning by which a table is judged. Kind: choice; a hundred rows of sixty columns.
const HEAD_BYTES: u64 = 128 << 10;

struct TextRows {
    source: Arc<SourceFile>,
    reader: Reader<BoundedRows<File>>,
    record: ByteRecord,
    separator: Separator,
    encoding: TableEncoding,
    width: usize,
    /// Rows that come before those of numbers.
    rows_before: usize,
}

/// Opens a text and finds out how it is written.
///
/// # Errors
/// It is no table of numbers.
pub(crate) fn open(path: &Path) -> Result<OpenTable, Diagnostic> {
    let mut file = open_regular(path, u64::MAX)?;
    let Dialect { text, quoting, rows_before, head } = dialect_of(&mut file, path)?;
    let source = SourceFile { path: path.to_owned(), text: String::new(), is_foreign: false };
    let source = Arc::new(source);
    let rows = TextRows {
        source: Arc::clone(&source),
        reader: text.separator.reader_builder(quoting).from_reader(BoundedRows::new(
            file,
            quoting,
            text.separator.byte(),
        )),
        record: ByteRecord::new(),
        separator: text.separator,
        encoding: text.encoding,
        width: head.width,
        rows_before,
    };
    Ok(OpenTable {
        source,
        head,
        rows: Box::new(rows),
        format: LogFormat::Table,
        text: Some(text),
        not_read: Vec::new(),
        warnings: Vec::new(),
        episodes: None,
    })
}

impl RowSource for TextRows {
    fn next_row(&mut self) -> Result<Option<TableRow>, Diagnostic> {
        loop {
            let is_row = self.reader.read_byte_record(&mut self.record);
            let refused = |fault: csv::Error| {
                let message = format!("the table cannot be read: {fault}");
                Diagnostic::error(codes::log::TABLE_ENCODING, message).in_file(&self.source)
            };
            if !is_row.map_err(refused)? {
                return Ok(None);
            }
            let cells = fitted(self.separator.cells(&self.record, self.encoding), self.width);
            if cells.iter().all(String::is_empty) {
                continue;
            }
            if self.rows_before == 0 {
                let line = self.record.position().map_or(0, csv::Position::line);
                return Ok(Some(TableRow { cells, line }));
            }
            self.rows_before -= 1;
        }
    }
}

/// The dialect by the whole rows of the beginning. The file is then at its beginning again.
fn dialect_of(file: &mut File, path: &Path) -> Result<Dialect, Diagnostic> {
    let failed = |fault| unreadable(path, &fault);
    let mut head = Vec::new();
    file.take(HEAD_BYTES).read_to_end(&mut head).map_err(failed)?;
    file.seek(SeekFrom::Start(0)).map_err(failed)?;
    let refused = |code: &'static Code, message: &str, help: &str| {
        Diagnostic::error(code, format!("{} {message}", path.display())).with_help(help)
    };
    if head.is_empty() {
        return Err(refused(congruent_input::codes::file::EMPTY, "is empty", "record it again"));
    }
    if head.starts_with(&[0xff, 0xfe]) || head.starts_with(&[0xfe, 0xff]) {
        let help = "save it as CSV in UTF-8; `iconv -f UTF-16 -t UTF-8 FILE` does it";
        return Err(refused(codes::log::TABLE_ENCODING, "is UTF-16", help));
    }
    if head.len() as u64 == HEAD_BYTES {
        let end = head.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
        head.truncate(end);
    }
    Dialect::of(&head).map_err(|fault| match fault {
        NoTable::NoNumbers => {
            let help = "a table has a row for each time, with numbers separated by commas, semicolons, tabulators or blanks";
            refused(codes::log::TABLE_ENCODING, "is no table of numbers", help)
        }
        NoTable::Header { names, cells } => {
            let message = format!("has {} in its header and {} in its rows", counted(names, "name"), counted(cells, "cell"));
            refused(codes::log::TABLE_ENCODING, &message, "give each column a name")
        }
    })
}
