//! What every format gives: rows of values.

use std::fmt;

/// One cell.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A number, in the unit of its column.
    Number(f64),
    /// The name of a link, a joint or a pair.
    Name(String),
    /// The cell is empty.
    Missing,
}

/// As it is written in CSV: numbers as the shortest text that is read back as the same number.
impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number:?}"),
            Self::Name(name) => f.write_str(name),
            Self::Missing => Ok(()),
        }
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
