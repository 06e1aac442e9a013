//! What a page shows over time.

mod buckets;
mod check_values;
mod distances;
mod plots;
mod run_series;

pub(crate) use distances::{ConstantPair, NearestOverTime};
pub(crate) use plots::{Chart, Floats, PlotLimit, PlotLine, PlotMark, PlotPoint, Plots};
pub(crate) use run_series::{JointQuantity, RunSeries};
