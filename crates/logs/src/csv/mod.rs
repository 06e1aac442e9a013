//! Logs as tables of numbers: CSV and its relatives. How a table is written, which column is which joint and in which unit its
//! times are is found by its beginning, and said in `TableReading`.

mod bounded_rows;
mod columns;
mod dialect;
mod number;
mod quantity;
mod reader;
mod time;

pub(crate) use reader::TableReader;
