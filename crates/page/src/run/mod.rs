//! The page of a run.

mod actuators;
mod cases;
mod checks;
mod content;
mod curves;
mod events;
mod failures;
mod faults;
mod figures;
mod header;
mod histogram;
mod joints;
mod over_time;
mod page;
mod recorder;
mod scene;
mod tightest;
mod violated;

pub(crate) use header::outcome;
pub use recorder::PageFormat;
pub(crate) use tightest::tightest;
