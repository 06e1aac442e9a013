//! Tables that are written cell by cell, as CSV or as Parquet.

mod cells;
mod csv;
mod parquet;

pub use cells::{ColumnKind, TableWriteError, TableWriter, WrittenCell, WrittenColumn};
pub use csv::CsvTable;
pub use parquet::ParquetTable;
