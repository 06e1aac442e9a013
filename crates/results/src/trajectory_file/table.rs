//! Tables that are written: their columns and cells, and what a format must do.

use congruent_monitors::RecordingError;

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
pub(super) enum TrajectoryCell<'a> {
    Count(u64),
    Number(f64),
    Name(&'a str),
    /// The source does not know the value.
    Missing,
}

/// A table that is written cell by cell, each row from its first column to its last.
pub(super) trait TableWriter {
    /// The next cell of the row.
    fn cell(&mut self, cell: TrajectoryCell<'_>);

    /// Writes the end of the present row.
    fn end_row(&mut self) -> Result<(), RecordingError>;

    /// Writes the end of the file and closes it.
    fn finish(self: Box<Self>) -> Result<(), RecordingError>;
}

/// An error with the message of another.
pub(super) fn failed(error: impl std::fmt::Display) -> RecordingError {
    RecordingError { message: format!("the trajectory: {error}") }
}
