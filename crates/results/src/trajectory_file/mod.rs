//! What happened in a run as a table, `trajectory.csv` or `trajectory.parquet`, or as a log of ROS 2, `trajectory.mcap`: written
//! while the run goes on, and read back. Not to be confused with [`congruent_motion::Trajectory`], which is what is planned.
//!
//! `columns.rs` decides what the columns are; `tables` writes CSV and Parquet, `run_log.rs` a log.

mod columns;
mod failed;
mod recorder;
mod run_log;
mod stride;

pub use congruent_tables::{RowReader, TableError, Value, open, run_columns::TIME};
