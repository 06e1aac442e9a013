//! What is recorded over time, gathered in columns and written in batches.

pub(crate) mod checks;
pub(crate) mod clearance;
pub(crate) mod colors;
pub(crate) mod disagreement;
mod distance_line;
pub(crate) mod extents;
pub(crate) mod joints;
pub(crate) mod pairs;
pub(crate) mod samples;
pub(crate) mod scalars;
pub(crate) mod zones;
