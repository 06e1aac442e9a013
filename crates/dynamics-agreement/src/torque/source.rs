//! A source of accelerations whose parameters are unknown: a physics engine, another library. Its acceleration under a known
//! torque is one exact sample of its inverse dynamics.

use congruent_description::RobotQ;
use congruent_dynamics::DrivenState;

use super::states::SampledState;
use crate::model::DynamicsModel;

/// A source of joint accelerations under given torques, such as a physics engine.
pub trait AccelerationSource {
    /// The mean acceleration over one step from a state under constant torques: change of speed over the step.
    ///
    /// | value | shape | unit |
    /// |---|---|---|
    /// | `state` | dof each | rad, m, s, N m, N |
    /// | `step_s` | 1 | s |
    /// | `qdd` | dof | rad/s^2, m/s^2 |
    ///
    /// # Errors
    /// The error of the source, as a sentence.
    fn acceleration_into(
        &mut self,
        state: &DrivenState<'_>,
        step_s: f64,
        qdd: &mut [f64],
    ) -> Result<(), String>;
}

/// Options of the identification of a source by its accelerations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IdentificationOptions {
    /// Seed of the random states.
    pub seed: u64,
    /// The largest of three steps, each half of the one before, s. It must be small against inertia over damping, which many
    /// engines integrate implicitly, and so small that dry friction stops no joint within it.
    pub step_s: f64,
}

/// The acceleration extrapolated to a step of zero from three steps.
///
/// The first two powers of the step are eliminated: Richardson, *The approximate arithmetical solution by finite
/// differences of physical problems* (1911).
pub(crate) fn acceleration(
    source: &mut dyn AccelerationSource,
    state: &DrivenState<'_>,
    step_s: f64,
) -> Result<Vec<f64>, String> {
    let mut of_step = |step_s: f64| {
        let mut qdd = vec![0.0; state.qd.len()];
        source.acceleration_into(state, step_s, &mut qdd).map(|()| qdd)
    };
    let [whole, half, quarter] = [of_step(step_s)?, of_step(step_s / 2.0)?, of_step(step_s / 4.0)?];
    let extrapolated = whole.iter().zip(&half).zip(&quarter).map(|((whole, half), quarter)| {
        // a(h) = a0 + c1 h + c2 h^2: two steps eliminate c1, and two of these results c2.
        let (coarse, fine) = (2.0 * half - whole, 2.0 * quarter - half);
        (4.0 * fine - coarse) / 3.0
    });
    Ok(extrapolated.collect())
}

/// States with the accelerations that the source has there, and the torques under which it has them.
pub(crate) fn sampled_states(
    model: &DynamicsModel,
    source: &mut dyn AccelerationSource,
    states: Vec<SampledState>,
    step_s: f64,
) -> Result<(Vec<SampledState>, Vec<Vec<f64>>), String> {
    let torques = super::reduced_difference::torques(model, &states).map_err(|error| error.to_string())?;
    let mut sampled_states = Vec::with_capacity(states.len());
    for (state, tau) in states.into_iter().zip(&torques) {
        // The torques come from the candidate: where both models agree, the source answers with the drawn
        // acceleration, and the states stay within their range.
        let driven = DrivenState { q: &state.q, qd: &state.qd, tau };
        let qdd = acceleration(source, &driven, step_s)?;
        if !qdd.iter().all(|value| value.is_finite()) {
            return Err("an acceleration is not finite".to_owned());
        }
        let (q, qd): (RobotQ, Vec<f64>) = (state.q, state.qd);
        sampled_states.push(SampledState { q, qd, qdd });
    }
    Ok((sampled_states, torques))
}
