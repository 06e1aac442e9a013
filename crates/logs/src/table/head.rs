//! What a format gives of a table: its beginning, and its rows as cells of text.

use std::sync::Arc;

use congruent_input::{Diagnostic, SourceFile};

use crate::{
    event::LogFormat,
    table_reading::{DecimalMark, TableEpisodes, TableText},
};

/// The beginning of a table, by which it is judged.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TableHead {
    /// The names of the columns; `None` without names.
    pub(crate) names: Option<Vec<String>>,
    /// Number of cells of a row.
    pub(crate) width: usize,
    /// The first rows of numbers.
    pub(crate) rows: Vec<Vec<String>>,
    pub(crate) decimal: DecimalMark,
}

impl TableHead {
    /// The name of a column, or its number from 1.
    pub(crate) fn name(&self, column: usize) -> String {
        let name = self.names.as_ref().and_then(|names| names.get(column));
        name.cloned().unwrap_or_else(|| format!("column {}", column + 1))
    }
}

/// A row of a table.
pub(crate) struct TableRow {
    pub(crate) cells: Vec<String>,
    /// Its line in a text; in another file its number from 1.
    pub(crate) line: u64,
}

/// The rows of a table, from the first one of numbers on.
pub(crate) trait RowSource {
    /// The next row; `None` behind the last.
    ///
    /// # Errors
    /// The rest cannot be read.
    fn next_row(&mut self) -> Result<Option<TableRow>, Diagnostic>;

    /// What was passed over since the last call.
    fn take_gaps(&mut self) -> Vec<Diagnostic> {
        Vec::new()
    }
}

/// A table of which the beginning was read.
pub(crate) struct OpenTable {
    pub(crate) source: Arc<SourceFile>,
    pub(crate) head: TableHead,
    pub(crate) rows: Box<dyn RowSource>,
    pub(crate) format: LogFormat,
    /// How a text is written; `None` if it is none.
    pub(crate) text: Option<TableText>,
    /// Columns of which nothing is read, beside those of the head.
    pub(crate) not_read: Vec<String>,
    /// What is suspicious about its head.
    pub(crate) warnings: Vec<Diagnostic>,
    /// The episodes that it has.
    pub(crate) episodes: Option<TableEpisodes>,
}
