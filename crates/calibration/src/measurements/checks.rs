//! Checks that both formats of measurements share.

use congruent_description::Robot;
use congruent_input::Diagnostic;

use crate::codes;

/// Largest joint position or coordinate of the tip, rad and m. Kind: plausibility.
const MOST: f64 = 1e6;

/// The fault of a file without measurements.
pub(super) fn no_rows() -> Diagnostic {
    Diagnostic::error(codes::measurements::NONE, "the file has no measurement").at(0..0)
}

/// The needed joints whose positions are not given.
pub(super) fn missing_joints(
    robot: &Robot,
    needed: &[usize],
    is_given: impl Fn(usize) -> bool,
) -> Option<String> {
    let joint = |coordinate: usize| robot.joint(robot.movable_joints()[coordinate]);
    let missing: Vec<&str> = needed
        .iter()
        .filter(|&&coordinate| joint(coordinate).mimic.is_none() && !is_given(coordinate))
        .map(|&coordinate| joint(coordinate).name.as_str())
        .collect();
    (!missing.is_empty()).then(|| missing.join(", "))
}

/// Refuses a value, in rad or m, that no robot has and whose square would exceed all others by more than the digits of a
/// double.
pub(super) fn plausible(value: f64) -> Result<f64, String> {
    if value.abs() <= MOST { Ok(value) } else { Err(format!("is too large (limit {MOST:e} rad or m)")) }
}
