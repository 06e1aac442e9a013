//! The folder of a sweep: what its cases are of, their rows as they come, and the tables of all.

mod cases;
mod digest;
mod folder;
mod header;
mod merged;
mod progress;
mod rows;
mod tables;

pub use cases::{CaseRange, missing};
pub use folder::{RowWriter, SweepFolder};
pub use header::SweepHeader;
pub use merged::{MergedTable, table_sha256};
pub use progress::SweepProgress;
pub(crate) use progress::verdict_counts;
pub use tables::{CASES_CSV, CASES_PARQUET, write_tables};
pub(crate) use tables::{csv_of_rows, number};
