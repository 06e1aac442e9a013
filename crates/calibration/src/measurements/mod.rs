//! Files of measurements: joint positions by name, and the measured pose or point of the tip.

mod checks;
mod columns;
mod csv;
mod json;
mod measured_row;
mod read;

pub use measured_row::{MeasuredRow, WrittenOrientation};
pub use read::read_measurements;
