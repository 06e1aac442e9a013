//! Which samples of a run are written.

use congruent_monitors::Sample;
use congruent_twin::RunSetup;

/// Steps from one written sample to the next.
#[derive(Clone, Copy)]
pub(super) struct Stride(u64);

impl Stride {
    /// By the period that the scenario asks for; the setup has checked that it is a whole number of steps.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the cast of floats saturates"
    )]
    pub(super) fn of(setup: &RunSetup) -> Self {
        let step_s = setup.clock.step_s;
        let period_s = setup.scenario.output.trajectory_period_s.unwrap_or(step_s);
        Self(((period_s / step_s).round() as u64).max(1))
    }

    /// Whether a sample is written: each at its turn, and the last.
    pub(super) fn takes(self, sample: &Sample<'_>) -> bool {
        sample.step.is_multiple_of(self.0) || sample.is_last
    }
}
