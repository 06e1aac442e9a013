//! What is recorded over time, gathered in columns and written in batches.

pub(crate) mod checks;
pub(crate) mod clearance;
pub(crate) mod disagreement;
pub(crate) mod joints;
pub(crate) mod samples;
pub(crate) mod scalars;
