//! Hypotheses on one actuator: the share of its effort that it exerts, and added friction of its joint.

use congruent_monitors::ConstantShare;
use congruent_scenario::{FaultKind, FaultQuantity, RunFault};

use super::{
    extent::extended,
    fit::{FaultFit, Window, best, least_squares},
    observed::{ObservedRun, spread},
    residual::{OffWindow, Residual},
};

/// A smaller share counts as 0: the rest is the truncation error of the engine's step.
const NO_SHARE: f64 = 0.01;
/// A joint slower than this part of its largest speed does not count as sliding: its dry friction may be any torque.
const SLIDING_PART: f64 = 0.02;

/// The best hypothesis on the actuator of a joint, of the residuals in a window of them.
pub(super) fn fault(
    observed: &ObservedRun<'_>,
    joint: usize,
    residuals: &[Residual],
    window: OffWindow,
) -> Option<FaultFit> {
    let of_window: Vec<&Residual> =
        // Samples in which friction may hold the joint say nothing about its actuator: any effort fits them.
        residuals[window.residuals.samples()].iter().filter(|residual| !residual.is_held[joint]).collect();
    let missing: Vec<f64> = of_window.iter().map(|residual| residual.missing[joint]).collect();
    let effort: Vec<f64> = of_window.iter().map(|residual| residual.effort[joint]).collect();
    let make = |kind: FaultKind, values: Vec<FaultQuantity>, expected: &dyn Fn(&Residual) -> f64| {
        let evidence = |residual: &Residual| window.evidence(residual, joint, expected(residual));
        let window = extended(window, residuals, observed.samples(), evidence);
        let (from_s, until_s) = observed.times(window.samples);
        let until_s = until_s.filter(|_| window.ends(residuals, joint, expected));
        let joints = vec![observed.name(joint)];
        RunFault { kind, joints, link: None, values, from_s, until_s }
    };
    let mut fits = Vec::new();
    // An actuator that exerts the share s of its reported effort lacks (s - 1) effort: one column, one parameter. One that is
    // known to deliver what it is commanded to has no such fault.
    let may_lack = observed.store.delivered(joint).is_all() != Some(true);
    let share = least_squares(std::slice::from_ref(&effort), &missing).filter(|_| may_lack);
    if let Some((parameters, remaining)) = share {
        let share = 1.0 + parameters[0];
        let expected = |residual: &Residual| parameters[0] * residual.effort[joint];
        let fault = if share.abs() < NO_SHARE {
            make(FaultKind::LostTorque, Vec::new(), &expected)
        } else {
            make(FaultKind::ScaledTorque, vec![FaultQuantity::share(share)], &expected)
        };
        // A negative share, or none in a joint that follows its setpoint, is another fault that least squares mimics: a joint
        // that nothing drives does not follow.
        let is_possible =
            share > NO_SHARE || (share > -NO_SHARE && !follows(observed, joint, window.samples));
        fits.extend(is_possible.then_some(FaultFit { fault, remaining, parameters: 1 }));
    }
    // Whether the friction ends is judged while the joint slides: at rest no friction would be missing.
    let fastest = fastest(joint, &of_window);
    fits.extend(friction(joint, &of_window).into_iter().map(|([dry, viscous], remaining)| {
        // Minus, as in the columns: what resists the motion is missing in its direction.
        let expected = |residual: &Residual| {
            let speed = residual.qd[1][joint];
            if speed.abs() > SLIDING_PART * fastest { -dry.copysign(speed) - viscous * speed } else { 0.0 }
        };
        let values = FaultQuantity::friction([dry, viscous], observed.unit(joint));
        // A part that is zero was not fitted, and a parameter fewer is the better explanation.
        let parameters = if dry > 0.0 && viscous > 0.0 { 2 } else { 1 };
        FaultFit { fault: make(FaultKind::AddedFriction, values, &expected), remaining, parameters }
    }));
    best(fits)
}

/// The share of its commanded effort that the actuator of a joint delivers, by both efforts: it is known although the motion shows
/// nothing, as that of a light joint beside the truncation error of a step.
pub(super) fn delivered_share(observed: &ObservedRun<'_>, joint: usize) -> Option<FaultFit> {
    let ConstantShare { share, first_step, end_step } = observed.store.delivered(joint).constant_share()?;
    let (kind, values) = if share.abs() < NO_SHARE {
        (FaultKind::LostTorque, Vec::new())
    } else {
        (FaultKind::ScaledTorque, vec![FaultQuantity::share(share)])
    };
    let fault = RunFault {
        kind,
        joints: vec![observed.name(joint)],
        link: None,
        values,
        // The effort of a sample has led to it, from the one before.
        from_s: observed.clock.time_s(first_step - 1),
        until_s: end_step.map(|step| observed.clock.time_s(step - 1)),
    };
    Some(FaultFit { fault, remaining: 0.0, parameters: 1 })
}

/// Whether a joint follows its moving setpoint.
fn follows(observed: &ObservedRun<'_>, joint: usize, window: Window) -> bool {
    /// Largest spread of the lag, as a part of the spread of the setpoint.
    const BEHIND: f64 = 0.1;
    /// A setpoint with a smaller spread is at rest, rad and m, so that nothing follows from it.
    const AT_REST: f64 = 1e-3;
    let setpoint = &observed.setpoint[joint][window.samples()];
    let q = &observed.q[joint][window.samples()];
    let behind: Vec<f64> = setpoint.iter().zip(q).map(|(setpoint, q)| setpoint - q).collect();
    spread(setpoint) > AT_REST && spread(&behind) < BEHIND * spread(setpoint)
}

/// Largest speed of a joint over some residuals, rad/s or m/s.
fn fastest(joint: usize, residuals: &[&Residual]) -> f64 {
    residuals.iter().map(|residual| residual.qd[1][joint].abs()).fold(0.0, f64::max)
}

/// Dry friction, viscous friction, and both, while the joint slides; each with its relative residual.
fn friction(joint: usize, residuals: &[&Residual]) -> Vec<([f64; 2], f64)> {
    let speed = |residual: &Residual| residual.qd[1][joint];
    let fastest = fastest(joint, residuals);
    let is_sliding = |residual: &&Residual| speed(residual).abs() > SLIDING_PART * fastest;
    let sliding: Vec<&Residual> = residuals.iter().copied().filter(is_sliding).collect();
    let missing: Vec<f64> = sliding.iter().map(|residual| residual.missing[joint]).collect();
    // Minus: what resists the motion is missing in its direction.
    let dry: Vec<f64> = sliding.iter().map(|residual| -speed(residual).signum()).collect();
    let viscous: Vec<f64> = sliding.iter().map(|residual| -speed(residual)).collect();
    let mut fits = Vec::new();
    // Each alone before both: noise always gives the second parameter some value.
    for (columns, places) in
        [(vec![dry.clone()], vec![0]), (vec![viscous.clone()], vec![1]), (vec![dry, viscous], vec![0, 1])]
    {
        let Some((parameters, remaining)) = least_squares(&columns, &missing) else { continue };
        // Friction takes energy: a negative parameter is a fit to something else.
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
