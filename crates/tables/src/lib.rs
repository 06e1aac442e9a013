//! Tables in CSV and Parquet: measurements, positions and torques over time, and what a run has written.
//!
//! [`WrittenTable`] gives rows whose cells know their lines and columns, for messages; [`open`] goes through a file of any
//! length without keeping it in memory. Both skip lines that begin with `#`.

pub mod codes;
mod json_list;
mod parquet;
mod read;
mod row_reader;
pub mod run_columns;
mod stream;
mod table;
pub mod writer;

pub use json_list::{JsonList, is_entry};
pub use read::read_table;
pub use row_reader::{RowReader, Value};
pub use stream::{TableError, is_csv, open};
pub use table::{Cell, Header, MOST_FAULTS, Row, TableRows, WrittenTable, separated_with_commas};
