//! Scalars over time.

use congruent_kinematics::larger;
use congruent_monitors::RecordingError;
use re_chunk::TimeColumn;
use re_log_types::EntityPath;
use re_sdk_types::archetypes::Scalars;

use crate::rrd::writer::{RrdWriter, failed};

/// Decimal logarithm of an error. An error below any rounding error counts as 1e-18, so that 0 has a value.
pub(crate) fn log10(error: f64) -> f64 {
    const FLOOR: f64 = 1e-18;
    libm::log10(larger(error, FLOOR))
}

/// Writes one scalar for each time.
pub(crate) fn write_scalars(
    writer: &mut RrdWriter,
    path: &EntityPath,
    times: &[TimeColumn],
    values: impl Iterator<Item = f64>,
) -> Result<(), RecordingError> {
    writer.columns(path, times, Scalars::new(values).columns_of_unit_batches().map_err(failed)?)
}
