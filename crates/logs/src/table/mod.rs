//! Tables of numbers as logs, whatever file they are in: which column is which joint and in which unit the times are is found by
//! the first rows, and said in `TableReading`.

mod columns;
mod head;
mod number;
mod quantity;
mod reader;
mod time;

pub(crate) use head::{OpenTable, RowSource, TableHead, TableRow};
pub(crate) use number::{CellValue, cell_value};
pub(crate) use quantity::says_quantity;
pub(crate) use reader::TableReader;
