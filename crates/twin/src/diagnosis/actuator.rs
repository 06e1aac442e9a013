//! Hypotheses on one actuator: what it exerts, and what resists its joint.

use super::{
    fit::{Fit, Window, best, least_squares},
    observed::{Observed, spread},
    residual::{OffWindow, Residual},
};
use crate::{
    fault::{FaultQuantity, RunFault},
    scenario::FaultKind,
};

/// A share below this is none: what is left is the difference of the engine's step.
const NO_SHARE: f64 = 0.01;
/// Slower than this part of the joint's largest speed, dry friction is not what slides.
const SLIDING_PART: f64 = 0.02;

/// The best hypothesis on the actuator of a joint, of the residuals in a window of them.
pub(super) fn fault(
    observed: &Observed<'_>,
    joint: usize,
    residuals: &[Residual],
    window: OffWindow,
) -> Option<Fit> {
    let of_window: Vec<&Residual> =
        residuals[window.residuals.samples()].iter().filter(|residual| !residual.is_held[joint]).collect();
    let left: Vec<f64> = of_window.iter().map(|residual| residual.missing[joint]).collect();
    let effort: Vec<f64> = of_window.iter().map(|residual| residual.effort[joint]).collect();
    let make = |kind: FaultKind, values: Vec<FaultQuantity>, ends: bool| {
        let (from_s, until_s) = observed.times(window.samples);
        let until_s = until_s.filter(|_| ends);
        let joints = vec![observed.name(joint)];
        RunFault { kind, joints, link: None, values, from_s, until_s }
    };
    let mut fits = Vec::new();
    if let Some((parameters, remaining)) = least_squares(std::slice::from_ref(&effort), &left) {
        let share = 1.0 + parameters[0];
        let ends = window.ends(residuals, joint, |residual| parameters[0] * residual.effort[joint]);
        let fault = if share.abs() < NO_SHARE {
            make(FaultKind::LostTorque, Vec::new(), ends)
        } else {
            make(FaultKind::ScaledTorque, vec![FaultQuantity::share(share)], ends)
        };
        // A joint that nothing drives does not follow its setpoint.
        let is_possible =
            share > NO_SHARE || (share > -NO_SHARE && !follows(observed, joint, window.samples));
        fits.extend(is_possible.then_some(Fit { fault, remaining, parameters: 1 }));
    }
    let fastest = fastest(joint, &of_window);
    fits.extend(friction(joint, &of_window).into_iter().map(|([dry, viscous], remaining)| {
        let ends = window.ends(residuals, joint, |residual| {
            let speed = residual.qd[1][joint];
            if speed.abs() > SLIDING_PART * fastest { dry.copysign(speed) + viscous * speed } else { 0.0 }
        });
        let values = FaultQuantity::friction([dry, viscous], observed.unit(joint));
        let parameters = if dry > 0.0 && viscous > 0.0 { 2 } else { 1 };
        Fit { fault: make(FaultKind::AddedFriction, values, ends), remaining, parameters }
    }));
    best(fits)
}

/// Whether a joint goes with its setpoint, which moves.
fn follows(observed: &Observed<'_>, joint: usize, window: Window) -> bool {
    /// How far behind it may be, as a part of the way of the setpoint.
    const BEHIND: f64 = 0.1;
    /// A setpoint that stands still says nothing, rad and m.
    const STANDS: f64 = 1e-3;
    let setpoint = &observed.setpoint[joint][window.samples()];
    let q = &observed.q[joint][window.samples()];
    let behind: Vec<f64> = setpoint.iter().zip(q).map(|(setpoint, q)| setpoint - q).collect();
    spread(setpoint) > STANDS && spread(&behind) < BEHIND * spread(setpoint)
}

/// Largest speed of a joint.
fn fastest(joint: usize, residuals: &[&Residual]) -> f64 {
    residuals.iter().map(|residual| residual.qd[1][joint].abs()).fold(0.0, f64::max)
}

/// Dry friction, viscous friction, and both, while the joint slides; with what each leaves.
fn friction(joint: usize, residuals: &[&Residual]) -> Vec<([f64; 2], f64)> {
    let speed = |residual: &Residual| residual.qd[1][joint];
    let fastest = fastest(joint, residuals);
    let is_sliding = |residual: &&Residual| speed(residual).abs() > SLIDING_PART * fastest;
    let sliding: Vec<&Residual> = residuals.iter().copied().filter(is_sliding).collect();
    let left: Vec<f64> = sliding.iter().map(|residual| residual.missing[joint]).collect();
    let dry: Vec<f64> = sliding.iter().map(|residual| -speed(residual).signum()).collect();
    let viscous: Vec<f64> = sliding.iter().map(|residual| -speed(residual)).collect();
    let mut fits = Vec::new();
    for (columns, places) in
        [(vec![dry.clone()], vec![0]), (vec![viscous.clone()], vec![1]), (vec![dry, viscous], vec![0, 1])]
    {
        let Some((parameters, remaining)) = least_squares(&columns, &left) else { continue };
        if parameters.iter().all(|&parameter| parameter > 0.0) {
            let mut both = [0.0; 2];
            places
                .iter()
                .zip(parameters)
                .for_each(|(&place, parameter): (&usize, f64)| both[place] = parameter);
            fits.push((both, remaining));
        }
    }
    fits
}
