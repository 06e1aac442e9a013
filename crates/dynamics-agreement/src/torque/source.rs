//! A source of accelerations whose parameters are unknown: a physics engine, another library. What it accelerates by under
//! a torque is an exact probe of its inverse dynamics.

use congruent_description::RobotQ;
use congruent_dynamics::DrivenState;

use super::states::State;
use crate::side::Side;

/// A source of accelerations.
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
    /// What went wrong, in words.
    fn acceleration_into(
        &mut self,
        state: &DrivenState<'_>,
        step_s: f64,
        qdd: &mut [f64],
    ) -> Result<(), String>;
}

/// How a source is probed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Probing {
    /// Seed of the states.
    pub seed: u64,
    /// The largest of three steps, each half of the one before. Damping is implicit in many engines: small against
    /// inertia over damping, and small enough that dry friction stops no joint within it.
    pub step_s: f64,
}

/// The acceleration of a step of zero, by three steps.
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
        let (coarse, fine) = (2.0 * half - whole, 2.0 * quarter - half);
        (4.0 * fine - coarse) / 3.0
    });
    Ok(extrapolated.collect())
}

/// Probes a source at states: each with the acceleration that it has under the torque beside it.
pub(crate) fn probed(
    side: &Side,
    source: &mut dyn AccelerationSource,
    states: Vec<State>,
    step_s: f64,
) -> Result<(Vec<State>, Vec<Vec<f64>>), String> {
    let torques = super::compressed::torques(side, &states).map_err(|error| error.to_string())?;
    let mut probed = Vec::with_capacity(states.len());
    for (state, tau) in states.into_iter().zip(&torques) {
        let driven = DrivenState { q: &state.q, qd: &state.qd, tau };
        let qdd = acceleration(source, &driven, step_s)?;
        if !qdd.iter().all(|value| value.is_finite()) {
            return Err("an acceleration is not finite".to_owned());
        }
        let (q, qd): (RobotQ, Vec<f64>) = (state.q, state.qd);
        probed.push(State { q, qd, qdd });
    }
    Ok((probed, torques))
}
