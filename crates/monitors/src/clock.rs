//! The clock and gravity of a run.

use congruent_input::{Diagnostic, display::quantity};
use congruent_scenario::{FilePlace, SimulationSettings};
use nalgebra::Vector3;

use crate::codes;

/// Longest step: beyond it no arm in `robots/` is stable.
const LONGEST_STEP_S: f64 = 0.01;
/// Most steps of one run: about an hour of computing.
const MOST_STEPS: f64 = 1e8;

/// Excess of a sum of durations over a whole number of steps that counts as none, in steps. Kind: rounding.
const ROUNDING: f64 = 1e-6;

/// The clock and the world of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct RunClock {
    /// Length of a physics step.
    pub step_s: f64,
    /// Number of steps of the whole run; `None` if only its source knows where it ends.
    pub steps: Option<u64>,
    /// Gravity, in the root link's frame, which is the world.
    pub gravity_in_world: Vector3<f64>,
}

impl RunClock {
    /// Time of the whole run; infinite if only its source knows where it ends.
    pub fn duration_s(&self) -> f64 {
        self.steps.map_or(f64::INFINITY, |steps| self.time_s(steps))
    }

    /// Simulated time after a number of steps.
    #[expect(clippy::cast_precision_loss, reason = "steps are bounded far below 2^52")]
    pub fn time_s(&self, steps: u64) -> f64 {
        steps as f64 * self.step_s
    }

    /// Number of steps if the run is longer by this time, as far as it is known.
    pub fn steps_with(&self, longer_s: f64) -> Option<u64> {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "some seconds, not negative"
        )]
        let more = (longer_s / self.step_s - ROUNDING).ceil() as u64;
        Some(self.steps? + more)
    }

    /// Without a duration the run ends with its motions; without both, with its source.
    ///
    /// # Errors
    /// The step or the duration is out of range.
    pub fn new(
        settings: &SimulationSettings,
        place: FilePlace<'_>,
        motions_s: f64,
        warnings: &mut Vec<Diagnostic>,
    ) -> Result<Self, Diagnostic> {
        let (step_s, duration_s) = (settings.step_s, settings.duration_s.unwrap_or(motions_s));
        let at_step = |error: Diagnostic| match (place.has("step_s"), place.has("duration_s")) {
            (true, _) => place.key("step_s").mark(error),
            (_, true) => place.key("duration_s").mark(error),
            _ => error,
        };
        if step_s > LONGEST_STEP_S {
            let message = format!("step_s = {step_s} is outside (0, {LONGEST_STEP_S}]");
            let error = Diagnostic::error(codes::scenario::STEP, message);
            return Err(at_step(error.with_help("0.001 suits every robot in robots/")));
        }
        let gravity_in_world = Vector3::from(settings.gravity_m_s2);
        if duration_s <= 0.0 {
            return Ok(Self { step_s, steps: None, gravity_in_world });
        }
        if step_s > duration_s {
            let message = format!("step_s = {step_s:?} s is longer than the run of {duration_s:?} s");
            return Err(at_step(Diagnostic::error(codes::scenario::STEP, message)));
        }
        let steps = duration_s / step_s;
        // A run without a duration does not end before its motions.
        let whole = match settings.duration_s {
            Some(_) => steps.round(),
            None => (steps - ROUNDING).ceil(),
        };
        if settings.duration_s.is_some() && (steps - whole).abs() > ROUNDING {
            let message =
                format!("duration_s = {duration_s:?} is not a whole number of steps of {step_s:?} s");
            let taken =
                format!("the duration is rounded to {whole} steps, {}", quantity(whole * step_s, "s"));
            let warning = Diagnostic::warning(codes::scenario::DURATION_ROUNDED, message);
            warnings.push(place.key("duration_s").mark(warning.with_help(taken)));
        }
        let steps = whole;
        if steps > MOST_STEPS {
            let message = format!(
                "{duration_s:?} s in steps of {step_s:?} s are {steps:e} steps, limit <= {MOST_STEPS:e}"
            );
            let error = Diagnostic::error(codes::scenario::STEPS, message);
            return Err(at_step(error.with_help("give a longer `step_s` or a shorter `duration_s`")));
        }
        if duration_s < motions_s - step_s / 2.0 {
            let message =
                format!("the run ends at {duration_s} s, before the end of its motions at {motions_s} s");
            let warning = Diagnostic::warning(codes::scenario::CUT_SHORT, message)
                .with_help("remove `duration_s` to run to the end of the motions");
            warnings.push(place.key("duration_s").mark(warning));
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 < steps <= 1e8")]
        let steps = steps as u64;
        Ok(Self { step_s, steps: Some(steps), gravity_in_world })
    }

    /// Whether a simulation, which ends with its motions, would ever end.
    ///
    /// # Errors
    /// There is neither a duration nor a motion.
    pub fn examine_length(&self) -> Result<(), Diagnostic> {
        if self.steps.is_some() {
            return Ok(());
        }
        Err(Diagnostic::error(codes::scenario::DURATION, "the run has no duration")
            .with_help("give `duration_s` under [simulation], or a [[motion]]"))
    }
}
