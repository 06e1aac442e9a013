//! Reads a table row by row, without its places.

use std::{
    fmt,
    fs::File,
    path::{Path, PathBuf},
};

use csv::{Reader, StringRecord};

use crate::{
    parquet::ParquetRows,
    row_reader::{RowReader, Value},
    run_columns::TIME,
    table::reader_builder,
};

/// Why a file is no table of a run.
#[derive(Debug, thiserror::Error)]
#[error("{} cannot be read as a trajectory: {message}", .path.display())]
pub struct TableError {
    /// Path of the file.
    pub path: PathBuf,
    /// The reason for which the file cannot be read.
    pub message: String,
}

impl TableError {
    fn new(path: &Path, error: impl fmt::Display) -> Self {
        Self { path: path.to_owned(), message: error.to_string() }
    }
}

/// Opens a table by the ending of its name: `.parquet`, or else comma-separated values.
///
/// # Errors
/// [`TableError`] if the file cannot be read, has no column `time_s`, or two of one name.
pub fn open(path: &Path) -> Result<Box<dyn RowReader>, TableError> {
    let file = File::open(path).map_err(|error| TableError::new(path, error))?;
    let rows: Result<Box<dyn RowReader>, String> = if is_parquet(path) {
        ParquetRows::new(file).map(|rows| Box::new(rows) as Box<dyn RowReader>)
    } else {
        CsvRows::new(file).map(|rows| Box::new(rows) as Box<dyn RowReader>)
    };
    let rows = rows.map_err(|error| TableError::new(path, error))?;
    let columns = rows.columns();
    if !columns.iter().any(|column| column == TIME) {
        return Err(TableError::new(path, format!("it has no column {TIME}")));
    }
    let twice = columns.iter().enumerate().find(|(at, column)| columns[..*at].contains(column));
    match twice {
        Some((_, column)) => Err(TableError::new(path, format!("it has two columns {column}"))),
        None => Ok(rows),
    }
}

pub(crate) fn is_parquet(path: &Path) -> bool {
    has_ending(path, "parquet")
}

/// Whether the name of a file says that it is a table in CSV.
pub fn is_csv(path: &Path) -> bool {
    has_ending(path, "csv")
}

fn has_ending(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending))
}

struct CsvRows {
    file: Reader<File>,
    columns: Vec<String>,
    record: StringRecord,
}

impl CsvRows {
    fn new(file: File) -> Result<Self, String> {
        let mut file = reader_builder().from_reader(file);
        let columns = file.headers().map_err(|error| error.to_string())?.iter().map(str::to_owned).collect();
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
