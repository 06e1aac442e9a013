//! Reading a file of measurements, CSV or JSON.

use std::path::Path;

use congruent_description::Robot;
use congruent_input::{Findings, read_text};

use super::{checks::no_rows, csv, json, measured_row::MeasuredRow};

/// Largest file that is read.
const MOST_BYTES: u64 = 64 << 20;

/// Reads a CSV or JSON file of measurements; each of `needed` (coordinates of the configuration
/// vector) must be given in every row.
///
/// A file whose first character is `[` is JSON: an array of `{"q": {joint: rad or m},
/// "translation_m": [x, y, z], "quaternion_wxyz": [w, x, y, z]}`, with `translation_mm`, `rpy_deg`,
/// `rpy_rad`, `rotation_vector_rad` as alternatives. Anything else is CSV with a header: `<joint>_rad`, `<joint>_deg`,
/// `<joint>_m` or `<joint>_mm`, then `x_m`, `y_m`, `z_m` (or `_mm`), and optionally `qw`, `qx`, `qy`, `qz`
/// or `roll_deg`, `pitch_deg`, `yaw_deg` or `rx_rad`, `ry_rad`, `rz_rad` (a rotation vector), unless the robot has a joint of that name. A coordinate may be left out, and a measured cell
/// be empty; lines that start with `#` are comments.
///
/// # Errors
/// Every fault that was found, with its line and column.
pub fn read_measurements(path: &Path, robot: &Robot, needed: &[usize]) -> Result<Vec<MeasuredRow>, Findings> {
    let source = read_text(path, MOST_BYTES)?;
    let rows = if source.text.trim_start().starts_with(['[', '{']) {
        json::parse(&source.text, robot, needed)
    } else {
        csv::parse(&source.text, robot, needed)
    };
    let rows = rows.and_then(|rows| if rows.is_empty() { Err(no_rows().into()) } else { Ok(rows) });
    rows.map_err(|faults| faults.into_iter().map(|fault| fault.in_file(&source)).collect())
}
