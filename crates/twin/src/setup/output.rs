//! `[output]` against the clock.

use congruent_description::Diagnostic;

use crate::scenario::{FilePlace, OutputSettings};

/// By how much of a step a period may be beside a multiple of it: the rounding of decimal fractions. Dimensionless.
const BESIDE_A_MULTIPLE: f64 = 1e-6;

/// Whether the settings fit each other and the step.
pub(super) fn check(settings: &OutputSettings, place: FilePlace<'_>, step_s: f64) -> Result<(), Diagnostic> {
    let Some(period_s) = settings.trajectory_period_s else { return Ok(()) };
    let mark = |error: Diagnostic| place.key("trajectory_period_s").mark(error);
    if settings.trajectory.is_none() {
        let message = "trajectory_period_s is given, but no trajectory is written";
        return Err(mark(
            Diagnostic::error("scenario::output", message)
                .with_help("add trajectory = \"csv\" or \"parquet\", or leave the period out"),
        ));
    }
    let steps = period_s / step_s;
    if (steps - steps.round()).abs() > BESIDE_A_MULTIPLE || steps.round() < 1.0 {
        let message =
            format!("trajectory_period_s = {period_s:?} is no multiple of the step, step_s = {step_s:?}");
        let near_s = steps.round().max(1.0) * step_s;
        return Err(mark(
            Diagnostic::error("scenario::output", message)
                .with_help(format!("rows are samples of the run; {near_s:?} is the nearest multiple")),
        ));
    }
    Ok(())
}
