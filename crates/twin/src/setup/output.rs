//! `[output]` against the clock.

use congruent_input::Diagnostic;
use congruent_monitors::RunClock;
use congruent_scenario::{FilePlace, Scenario};

use crate::codes;

/// Largest deviation of a period from a multiple of the step, in steps: the rounding of decimal fractions.
const BESIDE_A_MULTIPLE: f64 = 1e-6;

/// Whether the settings fit each other and the step.
pub(super) fn check(
    scenario: &Scenario,
    place: FilePlace<'_>,
    clock: Option<&RunClock>,
) -> Result<(), Diagnostic> {
    let settings = &scenario.output;
    let step_s = clock.map_or(scenario.simulation.step_s, |clock| clock.step_s);
    let Some(period_s) = settings.trajectory_period_s else { return Ok(()) };
    let mark = |error: Diagnostic| place.key("trajectory_period_s").mark(error);
    if settings.trajectory.is_none() {
        let message = "trajectory_period_s is given, but no trajectory is written";
        return Err(mark(
            Diagnostic::error(codes::scenario::OUTPUT, message)
                .with_help("add trajectory = \"csv\", \"parquet\" or \"mcap\", or remove the period"),
        ));
    }
    let steps = period_s / step_s;
    if (steps - steps.round()).abs() > BESIDE_A_MULTIPLE || steps.round() < 1.0 {
        let message = format!("trajectory_period_s = {period_s:?} is not a multiple of step_s = {step_s:?}");
        let near_s = steps.round().max(1.0) * step_s;
        return Err(mark(
            Diagnostic::error(codes::scenario::OUTPUT, message)
                .with_help(format!("the nearest multiple is {near_s:?}")),
        ));
    }
    Ok(())
}
