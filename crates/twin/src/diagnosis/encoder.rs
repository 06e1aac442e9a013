//! Hypotheses on encoders: measured position against the position that the poses show, joint by joint.

use super::{
    fit::{EXPLAINED, Fit, Window, best, least_squares, rms},
    observed::{Observed, ROUNDING, spread},
};
use crate::{
    fault::{FaultQuantity, RunFault},
    scenario::FaultKind,
};

/// The faults of encoders of `joints`.
pub(super) fn faults(observed: &Observed<'_>, joints: &[usize]) -> Vec<Fit> {
    let off: Vec<(usize, Window)> =
        joints.iter().filter_map(|&joint| Some((joint, wrong(observed, joint)?))).collect();
    let mut found = Vec::new();
    let mut is_explained = vec![false; off.len()];
    for a in 0..off.len() {
        for b in a + 1..off.len() {
            let free = !is_explained[a] && !is_explained[b];
            if let Some(fit) = free.then(|| swapped(observed, off[a], off[b])).flatten() {
                (is_explained[a], is_explained[b]) = (true, true);
                found.push(fit);
            }
        }
    }
    let rest = off.iter().zip(&is_explained).filter(|(_, is_explained)| !**is_explained);
    found.extend(rest.filter_map(|(&(joint, window), _)| best(alone(observed, joint, window))));
    found
}

/// When an encoder reads something else than the poses show.
pub(super) fn wrong(observed: &Observed<'_>, joint: usize) -> Option<Window> {
    let error = &observed.error[joint];
    let threshold = ROUNDING.max(noise(error)) + resolution(observed, joint);
    Window::of(error.len(), |sample| error[sample].abs() > threshold)
}

/// The steps of a reading that stands still at times while the joint moves: the smallest change that it shows. Zero for one
/// that follows.
fn resolution(observed: &Observed<'_>, joint: usize) -> f64 {
    let changes =
        |series: &[f64]| -> Vec<f64> { series.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect() };
    let (moved, read) = (changes(&observed.q[joint]), changes(&observed.measured[joint]));
    let stands = moved.iter().zip(&read).any(|(moved, read)| *moved > ROUNDING && *read <= 0.0);
    let smallest = read.into_iter().filter(|change| *change > 0.0).fold(f64::INFINITY, f64::min);
    if stands && smallest.is_finite() { smallest } else { 0.0 }
}

/// Six standard deviations of the noise of a series, by the median of its changes, which a fault does not move much. A
/// series that seldom turns is a motion, and has none.
fn noise(series: &[f64]) -> f64 {
    /// Median of the size of a normal variable, and the difference of two has twice the variance.
    const DEVIATIONS: f64 = 6.0 / (0.6745 * std::f64::consts::SQRT_2);
    /// Of noise, two of three changes are followed by one in the other direction.
    const SELDOM: f64 = 0.2;
    let mut changes: Vec<f64> = series.windows(2).map(|pair| pair[1] - pair[0]).collect();
    if changes.is_empty() {
        return 0.0; // a run that ends with its first sample
    }
    let turns = changes.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).count();
    #[expect(clippy::cast_precision_loss, reason = "samples are few")]
    if (turns as f64) < SELDOM * changes.len() as f64 {
        return 0.0;
    }
    for change in &mut changes {
        *change = change.abs();
    }
    changes.sort_by(f64::total_cmp);
    DEVIATIONS * changes[changes.len() / 2]
}

fn fault(
    observed: &Observed<'_>,
    kind: FaultKind,
    joints: &[usize],
    (values, window): (Vec<FaultQuantity>, Window),
) -> RunFault {
    let (from_s, until_s) = observed.times(window);
    let joints = joints.iter().map(|&joint| observed.name(joint)).collect();
    RunFault { kind, joints, link: None, values, from_s, until_s }
}

/// Both encoders read the other joint, from an own beginning.
fn swapped(observed: &Observed<'_>, a: (usize, Window), b: (usize, Window)) -> Option<Fit> {
    let window = Window { first: a.1.first.min(b.1.first), end: a.1.end.max(b.1.end) };
    let left = |joint: usize, other: usize| {
        let difference = |sample: usize| observed.measured[joint][sample] - observed.q[other][sample];
        let begin = difference(window.first);
        rms(window.samples().map(|sample| difference(sample) - begin))
    };
    let whole = rms(window.samples().map(|sample| observed.error[a.0][sample]))
        .max(rms(window.samples().map(|sample| observed.error[b.0][sample])));
    let begins_at_zero = |joint: usize| observed.error[joint][window.first].abs() <= EXPLAINED * whole;
    if whole <= 0.0 || !begins_at_zero(a.0) || !begins_at_zero(b.0) {
        return None;
    }
    let remaining = left(a.0, b.0).max(left(b.0, a.0)) / whole;
    let fault = fault(observed, FaultKind::SwappedJoints, &[a.0, b.0], (Vec::new(), window));
    (remaining <= EXPLAINED).then_some(Fit { fault, remaining, parameters: 2 })
}

/// Hypotheses on one encoder.
fn alone(observed: &Observed<'_>, joint: usize, window: Window) -> Vec<Fit> {
    let error: Vec<f64> = window.samples().map(|sample| observed.error[joint][sample]).collect();
    let mut fits = Vec::new();
    if let Some((parameters, remaining)) = least_squares(&[vec![1.0; error.len()]], &error) {
        let values = vec![FaultQuantity::offset(parameters[0], observed.unit(joint))];
        let fault = fault(observed, FaultKind::EncoderOffset, &[joint], (values, window));
        fits.push(Fit { fault, remaining, parameters: 1 });
    }
    fits.extend(drift(observed, joint, (window, &error)));
    fits.extend(flipped(observed, joint, (window, &error)));
    fits
}

/// A line over time; where it crosses zero, the fault begins.
fn drift(observed: &Observed<'_>, joint: usize, (window, error): (Window, &[f64])) -> Option<Fit> {
    let since_s: Vec<f64> =
        window.samples().map(|sample| observed.times_s[sample] - observed.times_s[window.first]).collect();
    let (parameters, remaining) = least_squares(&[vec![1.0; error.len()], since_s], error)?;
    let [at_first, rate] = parameters[..] else { return None };
    let values = vec![FaultQuantity::rate(rate, observed.unit(joint))];
    let mut fault = fault(observed, FaultKind::EncoderDrift, &[joint], (values, window));
    let step_s = observed.clock.step_s;
    let begin_s = fault.from_s - at_first / rate;
    // A drift begins at zero: anything else has come before the first sample, and is none.
    if !begin_s.is_finite() || (begin_s - fault.from_s).abs() > 10.0 * step_s {
        return None;
    }
    fault.from_s = ((begin_s / step_s).round() * step_s).max(0.0);
    Some(Fit { fault, remaining, parameters: 2 })
}

/// The reading goes back as the joint goes forth: the error has the slope -2 over the position.
fn flipped(observed: &Observed<'_>, joint: usize, (window, error): (Window, &[f64])) -> Option<Fit> {
    let q = &observed.q[joint][window.first..window.end];
    // It counts from where it stands: what jumps is an offset.
    if spread(q) <= ROUNDING || error[0].abs() > EXPLAINED * spread(error) {
        return None;
    }
    let twice: Vec<f64> = error.iter().zip(q).map(|(error, q)| error + 2.0 * q).collect();
    let (_, left) = least_squares(&[vec![1.0; twice.len()]], &twice)?;
    let remaining = left * rms(twice.iter().copied()) / rms(error.iter().copied());
    let fault = fault(observed, FaultKind::FlippedAxis, &[joint], (Vec::new(), window));
    Some(Fit { fault, remaining, parameters: 1 })
}
