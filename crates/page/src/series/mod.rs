//! What a page shows over time.

mod buckets;
mod distances;
mod plots;
mod run_series;

pub(crate) use distances::NearestOverTime;
pub(crate) use plots::{Chart, PlotLimit, PlotLine, PlotMark, Plots};
pub(crate) use run_series::{JointQuantity, RunSeries};
