//! Reads a table back, row by row.

use std::path::Path;

use super::{
    csv::CsvRows,
    parquet::ParquetRows,
    table::{RowReader, TIME, TableError},
};

/// Opens a table by the ending of its name: `.parquet`, or else comma-separated values.
///
/// # Errors
/// [`TableError`] if the file cannot be read, has no column `time_s`, or two of one name.
pub fn open(path: &Path) -> Result<Box<dyn RowReader>, TableError> {
    let is_parquet = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("parquet"));
    let rows: Box<dyn RowReader> =
        if is_parquet { Box::new(ParquetRows::open(path)?) } else { Box::new(CsvRows::open(path)?) };
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
