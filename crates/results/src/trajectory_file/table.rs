//! Tables: their columns and cells, and what a format must do.

use std::path::{Path, PathBuf};

use congruent_monitors::RecordingError;

/// The name of the column of time.
pub const TIME: &str = "time_s";

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ColumnKind {
    /// Whole numbers, one in each row.
    Count,
    /// Numbers; a cell may be empty.
    Number,
    /// Names; a cell may be empty.
    Name,
}

/// A column of a table that is written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct TrajectoryColumn {
    pub(super) name: String,
    pub(super) kind: ColumnKind,
}

/// One cell as it is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Cell<'a> {
    Count(u64),
    Number(f64),
    Name(&'a str),
    /// The source does not know the value.
    Missing,
}

/// One cell as it is read.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A number, in the unit of its column.
    Number(f64),
    /// The name of a link, a joint or a pair.
    Name(String),
    /// The cell is empty.
    Missing,
}

/// A table that is written cell by cell, each row from its first column to its last.
pub(super) trait TableWriter {
    /// The next cell of the row.
    fn cell(&mut self, cell: Cell<'_>);

    /// Writes the end of the present row.
    fn end_row(&mut self) -> Result<(), RecordingError>;

    /// Writes the end of the file and closes it.
    fn finish(self: Box<Self>) -> Result<(), RecordingError>;
}

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
    pub(super) fn new(path: &Path, error: impl std::fmt::Display) -> Self {
        Self { path: path.to_owned(), message: error.to_string() }
    }
}

/// A table that is read row by row.
pub trait RowReader {
    /// The names of the columns.
    fn columns(&self) -> &[String];

    /// Reads the next row into `row`, one value for each column; `false` after the last.
    ///
    /// # Errors
    /// The message of the reader if the rest of the file cannot be read.
    fn next_row(&mut self, row: &mut Vec<Value>) -> Result<bool, String>;
}

/// An error with the message of another.
pub(super) fn failed(error: impl std::fmt::Display) -> RecordingError {
    RecordingError { message: format!("the trajectory: {error}") }
}
