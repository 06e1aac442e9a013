//! Tables as comma-separated values. Numbers are the shortest text that is read back as the same number.

use std::{fmt::Write, fs::File, io, path::Path};

use csv::Writer;

use super::cells::{TableWriteError, TableWriter, WrittenCell, WrittenColumn, failed};

/// Rows between two writes to the file: a run that is killed has written all but the last of them.
const ROWS_A_FLUSH: u32 = 1000;

/// A table as comma-separated values.
#[derive(Debug)]
pub struct CsvTable<W: io::Write = File> {
    file: Writer<W>,
    text: String,
    rows: u32,
    /// The first error of a row, which is reported at its end.
    error: Option<csv::Error>,
}

impl CsvTable {
    /// A new file with its header; one that is there is replaced.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn create(path: &Path, columns: &[WrittenColumn]) -> Result<Self, TableWriteError> {
        Self::new(Writer::from_path(path).map_err(failed)?, columns)
    }
}

impl<W: io::Write> CsvTable<W> {
    /// A table with its header that goes to a writer.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn to(writer: W, columns: &[WrittenColumn]) -> Result<Self, TableWriteError> {
        Self::new(Writer::from_writer(writer), columns)
    }

    fn new(mut file: Writer<W>, columns: &[WrittenColumn]) -> Result<Self, TableWriteError> {
        file.write_record(columns.iter().map(|column| &column.name)).map_err(failed)?;
        Ok(Self { file, text: String::new(), rows: 0, error: None })
    }
}

impl<W: io::Write> TableWriter for CsvTable<W> {
    fn cell(&mut self, cell: WrittenCell<'_>) {
        self.text.clear();
        let written = match cell {
            WrittenCell::Count(count) => write!(self.text, "{count}"),
            WrittenCell::Number(number) => write!(self.text, "{number:?}"),
            WrittenCell::Name(_) | WrittenCell::Missing => Ok(()),
        };
        let text = if let WrittenCell::Name(name) = cell { name } else { &self.text };
        let written = written.map_err(|error| io::Error::other(error).into());
        self.error = self.error.take().or(written.and_then(|()| self.file.write_field(text)).err());
    }

    fn end_row(&mut self) -> Result<(), TableWriteError> {
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

    fn finish(mut self: Box<Self>) -> Result<(), TableWriteError> {
        self.file.flush().map_err(failed)
    }
}
