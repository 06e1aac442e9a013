//! The text of a table that another file names.

use std::{path::Path, sync::Arc};

use congruent_input::{Diagnostic, FileAccess, SourceFile, TextKind};

use crate::{codes, parquet::ParquetRows, row_reader::RowReader, stream::is_parquet};

/// The text of a table in CSV, or that which a Parquet file has as CSV: lines in messages are those of this text.
///
/// # Errors
/// The file may not be opened, cannot be read, or is longer than `most_bytes`, as a file or as text.
pub fn read_table(access: &FileAccess, path: &Path, most_bytes: u64) -> Result<Arc<SourceFile>, Diagnostic> {
    if !is_parquet(path) {
        return access.read_text(path, most_bytes, TextKind::Table);
    }
    let bytes = access.read_bytes(path, most_bytes)?;
    let text = ParquetRows::new(bytes::Bytes::from(bytes)).and_then(|rows| csv_text(rows, most_bytes));
    let refused = |message| {
        let message = format!("{} cannot be read as a Parquet table: {message}", path.display());
        Diagnostic::error(codes::table::PARQUET, message)
    };
    let is_foreign = access.is_foreign(path);
    Ok(Arc::new(SourceFile { path: path.to_owned(), text: text.map_err(refused)?, is_foreign }))
}

fn csv_text(mut rows: impl RowReader, most_bytes: u64) -> Result<String, String> {
    let mut text = csv::Writer::from_writer(Vec::new());
    let refused = |error: csv::Error| error.to_string();
    text.write_record(rows.columns()).map_err(refused)?;
    let mut row = Vec::new();
    // A few bytes of Parquet can stand for any number of equal values.
    while rows.next_row(&mut row)? {
        text.write_record(row.iter().map(ToString::to_string)).map_err(refused)?;
        if text.get_ref().len() as u64 > most_bytes {
            return Err(format!("it has more than {most_bytes} bytes as CSV"));
        }
    }
    let bytes = text.into_inner().map_err(|error| error.to_string())?;
    String::from_utf8(bytes).map_err(|error| error.to_string())
}
