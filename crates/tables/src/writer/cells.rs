//! Tables that are written: their columns and cells, and what a format must do.

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColumnKind {
    /// Whole numbers, one in each row.
    Count,
    /// Numbers; a cell may be empty.
    Number,
    /// Names; a cell may be empty.
    Name,
}

/// A column of a table that is written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WrittenColumn {
    /// Its name, with the unit at its end.
    pub name: String,
    /// What it holds.
    pub kind: ColumnKind,
}

/// One cell as it is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum WrittenCell<'a> {
    /// A whole number.
    Count(u64),
    /// A number.
    Number(f64),
    /// A text.
    Name(&'a str),
    /// The source does not know the value.
    Missing,
}

/// A table that is written cell by cell, each row from its first column to its last.
pub trait TableWriter {
    /// The next cell of the row.
    fn cell(&mut self, cell: WrittenCell<'_>);

    /// Writes the end of the present row.
    ///
    /// # Errors
    /// It cannot be written.
    fn end_row(&mut self) -> Result<(), TableWriteError>;

    /// Writes the end of the file and closes it.
    ///
    /// # Errors
    /// It cannot be written.
    fn finish(self: Box<Self>) -> Result<(), TableWriteError>;
}

/// Why a table cannot be written.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct TableWriteError(String);

impl From<std::io::Error> for TableWriteError {
    fn from(error: std::io::Error) -> Self {
        failed(error)
    }
}

/// An error with the message of another.
pub(super) fn failed(error: impl std::fmt::Display) -> TableWriteError {
    TableWriteError(error.to_string())
}
