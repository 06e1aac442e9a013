//! Reports as pages: one HTML file each, which carries its style, its script and its data, needs no network, and prints.
//!
//! Text and numbers come from the reports; each rounded number carries the exact one and its place in the JSON report
//! (`<data data-path value>`), so that a test can compare the two. Text from files is escaped by maud.

mod assets;
mod calibration;
mod camera;
mod check;
mod index;
mod parts;
mod picture;
mod run;
mod series;
mod sweep;

pub use calibration::{CalibrationSource, calibration_page};
pub use check::{CheckEntry, CheckedRobot, check_page};
pub use index::{IndexEntry, index_page};
pub use run::PageFormat;
pub use sweep::sweep_page;
