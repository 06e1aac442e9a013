//! Tables as comma-separated values. Numbers are the shortest text that is read back as the same number.

use std::{fmt::Write, fs::File, io, path::Path};

use congruent_monitors::RecordingError;
use csv::{Reader, StringRecord, Writer};

use super::table::{Cell, RowReader, TableError, TableWriter, TrajectoryColumn, Value, failed};

/// Rows between two writes to the file: a run that is killed has written all but the last of them.
const ROWS_A_FLUSH: u32 = 1000;

pub(super) struct CsvTable {
    file: Writer<File>,
    text: String,
    rows: u32,
    /// The first error of a row, which is reported at its end.
    error: Option<csv::Error>,
}

impl CsvTable {
    pub(super) fn create(path: &Path, columns: &[TrajectoryColumn]) -> Result<Self, RecordingError> {
        let mut file = Writer::from_path(path).map_err(failed)?;
        file.write_record(columns.iter().map(|column| &column.name)).map_err(failed)?;
        Ok(Self { file, text: String::new(), rows: 0, error: None })
    }
}

impl TableWriter for CsvTable {
    fn cell(&mut self, cell: Cell<'_>) {
        self.text.clear();
        let written = match cell {
            Cell::Count(count) => write!(self.text, "{count}"),
            Cell::Number(number) => write!(self.text, "{number:?}"),
            Cell::Name(_) | Cell::Missing => Ok(()),
        };
        let text = if let Cell::Name(name) = cell { name } else { &self.text };
        let written = written.map_err(|error| io::Error::other(error).into());
        self.error = self.error.take().or(written.and_then(|()| self.file.write_field(text)).err());
    }

    fn end_row(&mut self) -> Result<(), RecordingError> {
        if let Some(error) = self.error.take() {
            return Err(failed(error));
        }
        self.file.write_record(None::<&[u8]>).map_err(failed)?;
        self.rows += 1;
        if self.rows.is_multiple_of(ROWS_A_FLUSH) {
            self.file.flush().map_err(failed)?;
        }
        Ok(())
    }

    fn finish(mut self: Box<Self>) -> Result<(), RecordingError> {
        self.file.flush().map_err(failed)
    }
}

pub(super) struct CsvRows {
    file: Reader<File>,
    columns: Vec<String>,
    record: StringRecord,
}

impl CsvRows {
    pub(super) fn open(path: &Path) -> Result<Self, TableError> {
        let refused = |error: csv::Error| TableError::new(path, error);
        let mut file = Reader::from_path(path).map_err(refused)?;
        let columns = file.headers().map_err(refused)?.iter().map(str::to_owned).collect();
        Ok(Self { file, columns, record: StringRecord::new() })
    }
}

impl RowReader for CsvRows {
    fn columns(&self) -> &[String] {
        &self.columns
    }

    fn next_row(&mut self, row: &mut Vec<Value>) -> Result<bool, String> {
        if !self.file.read_record(&mut self.record).map_err(|error| error.to_string())? {
            return Ok(false);
        }
        row.clear();
        row.extend(self.record.iter().map(value));
        Ok(true)
    }
}

fn value(text: &str) -> Value {
    match text.parse() {
        _ if text.is_empty() => Value::Missing,
        Ok(number) => Value::Number(number),
        Err(_) => Value::Name(text.to_owned()),
    }
}
