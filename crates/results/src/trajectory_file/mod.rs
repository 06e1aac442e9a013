//! What happened in a run as a table, `trajectory.csv` or `trajectory.parquet`, or as a log of ROS 2, `trajectory.mcap`: written
//! while the run goes on, and read back. Not to be confused with [`congruent_motion::Trajectory`], which is what is planned.
//!
//! `columns.rs` decides what the columns are; `csv.rs`, `parquet.rs` and `run_log.rs` each know one format.

mod columns;
mod csv;
mod parquet;
mod recorder;
mod run_log;
mod stride;
mod table;

pub use congruent_tables::{RowReader, TableError, Value, open, run_columns::TIME};
