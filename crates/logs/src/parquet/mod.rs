//! Tables in Parquet, and datasets of LeRobot, which are made of them: rows as text, which are then read as those of any table.

mod columns;
mod dataset;
mod episodes;
mod rows;
#[cfg(test)]
mod write;

pub(crate) use dataset::is_dataset;
pub(crate) use episodes::refused as episode_refused;
pub(crate) use rows::open;
