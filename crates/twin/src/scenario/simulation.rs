//! `[simulation]`: clock and gravity.

use congruent_description::{Diagnostic, fixed_array};
use nalgebra::Vector3;
use serde::Deserialize;
use toml::Spanned;

use super::{
    SimulationSettings,
    number::{Finite, Positive},
    section::Section,
};

/// Longest step: beyond it no arm in `robots/` is stable.
const LONGEST_STEP_S: f64 = 0.01;
/// Most steps of one run: about an hour of computing.
const MOST_STEPS: f64 = 1e8;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Simulation {
    step_s: Option<Spanned<Positive>>,
    duration_s: Option<Spanned<Positive>>,
    #[serde(default, deserialize_with = "fixed_array")]
    gravity_m_s2: Option<Spanned<[Finite; 3]>>,
}

/// The clock and gravity; without a duration the run ends with its motions.
pub(super) fn read(
    section: Option<Section<'_>>,
    motions_s: f64,
    warnings: &mut Vec<Diagnostic>,
) -> Result<SimulationSettings, Vec<Diagnostic>> {
    let written = match section {
        Some(section) => section.read()?,
        None => Simulation { step_s: None, duration_s: None, gravity_m_s2: None },
    };
    let step_s = written.step_s.as_ref().map_or(0.001, |step| step.get_ref().get());
    let duration_s = written.duration_s.as_ref().map_or(motions_s, |duration| duration.get_ref().get());
    let at = |error: Diagnostic, place: Option<&Spanned<Positive>>| match place {
        Some(figure) => error.at(figure.span()),
        None => error,
    };
    let (step, duration) = (written.step_s.as_ref(), written.duration_s.as_ref());
    if step_s > LONGEST_STEP_S {
        let error = Diagnostic::error(
            "scenario::step",
            format!("step_s = {step_s} is outside (0, {LONGEST_STEP_S}]"),
        );
        return Err(at(error.with_help("0.001 suits every robot in robots/"), step).into());
    }
    if duration_s <= 0.0 {
        return Err(Diagnostic::error("scenario::duration", "the run has no duration")
            .with_help("give `duration_s` under [simulation], or a [[motion]]")
            .into());
    }
    if step_s > duration_s {
        let message = format!("step_s = {step_s:?} is longer than the run ({duration_s:?} s)");
        return Err(at(Diagnostic::error("scenario::step", message), step.or(duration)).into());
    }
    let steps = (duration_s / step_s).round();
    if steps > MOST_STEPS {
        let message = format!("{duration_s:?} s in steps of {step_s:?} s are {steps:e} steps");
        let error = Diagnostic::error("scenario::steps", message)
            .with_help(format!("at most {MOST_STEPS:e} steps are run at once"));
        return Err(at(error, step.or(duration)).into());
    }
    if duration_s < motions_s - step_s / 2.0 {
        let message = format!("the run ends at {duration_s} s, its motions at {motions_s} s");
        let warning = Diagnostic::warning("scenario::cut_short", message);
        warnings.push(at(warning.with_help("leave `duration_s` out to run to their end"), duration));
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 < steps <= 1e8")]
    let steps = steps as u64;
    let gravity =
        written.gravity_m_s2.map_or([0.0, 0.0, -9.81], |gravity| gravity.into_inner().map(Finite::get));
    Ok(SimulationSettings { step_s, steps, gravity_in_world: Vector3::from(gravity) })
}
