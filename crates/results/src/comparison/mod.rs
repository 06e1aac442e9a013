//! Two runs against each other, by what they have written: the first difference in time and the worst one of each
//! series. `tables.rs` compares trajectories, `scalars.rs` series that were read elsewhere, `reports.rs` reports.

mod difference;
mod file_comparison;
mod report_label;
mod reports;
mod scalars;
mod series;
mod tables;

pub use difference::{SeriesDifference, ValueDifference};
pub use file_comparison::{ComparedFile, FileComparison};
pub use reports::compare_reports;
pub use scalars::{ScalarLabel, Scalars, compare_scalars};
pub use tables::compare_tables;
