//! Hypotheses on the way from encoders to controller: readings arrive late, or not at all.

use super::{
    encoder::{DISTINCT, SIGNIFICANT},
    fit::{EXPLAINED, Fit, Window, rms},
    noise::ROUNDING,
    observed::Observed,
};
use crate::{
    fault::{FaultQuantity, RunFault},
    scenario::FaultKind,
};

/// Readings that got lost.
pub(super) struct Dropped {
    pub(super) fit: Fit,
    /// The samples of which the reading got lost.
    pub(super) is_held: Vec<bool>,
    /// The samples that would show it: of the others a lost reading looks like one of the present.
    pub(super) would_show: Vec<bool>,
}

/// Readings that repeat the one before to the last bit in every joint although that would not happen by chance.
pub(super) fn dropped(observed: &Observed<'_>, joints: &[usize]) -> Option<Dropped> {
    /// Chance of a repetition below which it is one of a reading that got lost.
    const CHANCE: f64 = 1e-6;
    let tells = |sample: usize| {
        sample > 0
            && observed.are_consecutive(sample - 1, sample)
            && joints.iter().map(|&joint| repeats_by_chance(observed, joint, sample)).product::<f64>()
                < CHANCE
    };
    let repeats = |sample: usize| {
        observed.measured.iter().all(|q| sample > 0 && q[sample].to_bits() == q[sample - 1].to_bits())
    };
    let tells: Vec<bool> = (0..observed.samples()).map(tells).collect();
    let window = Window::of(observed.samples(), |sample| tells[sample] && repeats(sample))?;
    let telling = || window.samples().filter(|&sample| tells[sample]);
    #[expect(clippy::cast_precision_loss, reason = "samples are few")]
    let (lost, all) = (telling().filter(|&sample| repeats(sample)).count() as f64, telling().count() as f64);
    // Readings that all repeat are those of one that was the first to arrive late.
    if lost >= all {
        return None;
    }
    let errors = |of_repeats: bool| {
        let samples = telling().filter(move |&sample| repeats(sample) == of_repeats);
        rms(samples.flat_map(|sample| {
            joints.iter().map(move |&joint| {
                let beyond = observed.error[joint][sample].abs() - observed.uncertainty[joint].largest();
                beyond.max(0.0)
            })
        }))
    };
    let (others, of_repeats) = (errors(false), errors(true));
    let remaining = if others > 0.0 { (others / of_repeats).min(1.0) } else { 0.0 };
    let value = FaultQuantity::share(lost / all);
    let is_held = (0..observed.samples()).map(|sample| tells[sample] && repeats(sample)).collect();
    let fit = fit(observed, FaultKind::DroppedSamples, (value, window, joints), remaining);
    Some(Dropped { fit, is_held, would_show: tells })
}

/// A bound of the chance that a reading repeats the one before.
fn repeats_by_chance(observed: &Observed<'_>, joint: usize, sample: usize) -> f64 {
    let uncertainty = observed.uncertainty[joint];
    let (q, noise) = (&observed.q[joint], uncertainty.noise);
    let late = observed.late.map_or(0, |(_, steps)| steps);
    let Some(then) = sample.checked_sub(late).filter(|then| *then > 0) else { return 1.0 };
    // Readings of a latency begin and end with it: a joint that moves shows it on either side.
    let moved = (q[sample] - q[sample - 1]).abs().min((q[then] - q[then - 1]).abs());
    // Seven standard deviations of a difference of two readings.
    if moved > uncertainty.resolution + 10.0 * noise + ROUNDING {
        return 0.0;
    }
    if noise <= ROUNDING {
        return 1.0;
    }
    // Two numbers with this noise are within a step of each other; a double has steps as well, far below.
    (uncertainty.resolution.max(f64::EPSILON) / (std::f64::consts::PI.sqrt() * noise)).min(1.0)
}

fn fit(
    observed: &Observed<'_>,
    kind: FaultKind,
    (value, window, joints): (FaultQuantity, Window, &[usize]),
    remaining: f64,
) -> Fit {
    let (from_s, until_s) = observed.times_in_motion(window, joints);
    let fault = RunFault { kind, joints: Vec::new(), link: None, values: vec![value], from_s, until_s };
    Fit { fault, remaining, parameters: 1 }
}

/// Readings of an earlier time.
pub(super) struct Late {
    pub(super) fit: Fit,
    pub(super) window: Window,
    pub(super) steps: usize,
    /// Variances of the noise that it explains.
    pub(super) gain: f64,
}

/// All readings are those of an earlier time.
pub(super) fn late(observed: &Observed<'_>, joints: &[usize]) -> Option<Late> {
    let most = observed.store.steps().last()? / 2;
    let mut best = std::iter::successors(Some(1_u64), |steps| Some(steps + 1 + steps / 4))
        .take_while(|steps| *steps <= most)
        .map(|steps| (steps, shifted(observed, joints, steps)))
        .max_by(|a, b| a.1.1.total_cmp(&b.1.1))?;
    let mut by = (best.0 / 4).max(1);
    while by > 0 {
        let near = [best.0.saturating_sub(by).max(1), best.0 + by];
        let better = near.map(|steps| (steps, shifted(observed, joints, steps)));
        match better.into_iter().max_by(|a, b| a.1.1.total_cmp(&b.1.1)).filter(|near| near.1.1 > best.1.1) {
            Some(near) => best = near,
            None => by /= 2,
        }
    }
    let (steps, (window, gain)) = best;
    let remaining =
        joints.iter().map(|&joint| remaining(observed, joint, (steps, window))).fold(0.0, f64::max);
    let is_told =
        gain > SIGNIFICANT && remaining <= EXPLAINED && is_beyond_steps(observed, joints, (steps, window));
    #[expect(clippy::cast_precision_loss, reason = "steps of a run are far below 2^52")]
    let value = FaultQuantity::latency(steps as f64 * observed.clock.step_s);
    let fit = fit(observed, FaultKind::Latency, (value, window, joints), remaining);
    is_told.then_some(Late { fit, window, steps: usize::try_from(steps).ok()?, gain })
}

/// What a reading that arrives late adds to that of the present, at every sample.
fn added(observed: &Observed<'_>, joint: usize, steps: u64) -> impl Fn(usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "steps of a run are far below 2^52")]
    let latency_s = steps as f64 * observed.clock.step_s;
    let (q, times_s) = (&observed.q[joint], &observed.times_s);
    move |sample| interpolated(q, position_in_time(times_s, times_s[sample] - latency_s)) - q[sample]
}

/// The window in which a latency explains most, in variances: the largest sum of successive samples.
fn shifted(observed: &Observed<'_>, joints: &[usize], steps: u64) -> (Window, f64) {
    let mut gains = vec![0.0; observed.samples()];
    for &joint in joints {
        let (error, added) = (&observed.error[joint], added(observed, joint, steps));
        let variance = observed.uncertainty[joint].variance();
        for sample in observed.used() {
            let added = added(sample);
            gains[sample] += added * (2.0 * error[sample] - added) / variance;
        }
    }
    let (mut best, mut first, mut sum) = ((Window { first: 0, end: 0 }, 0.0), 0, 0.0);
    for (sample, gain) in gains.iter().enumerate() {
        if sum <= 0.0 {
            (first, sum) = (sample, 0.0);
        }
        sum += gain;
        if sum > best.1 {
            best = (Window { first, end: sample + 1 }, sum);
        }
    }
    // It lasts if what follows does not say otherwise.
    if gains[best.0.end..].iter().sum::<f64>() > -DISTINCT {
        best.0.end = gains.len();
    }
    best
}

/// What a latency leaves of the difference of a joint beyond noise, as a part.
fn remaining(observed: &Observed<'_>, joint: usize, (steps, window): (u64, Window)) -> f64 {
    let (error, added) = (&observed.error[joint], added(observed, joint, steps));
    let (mut whole, mut left, mut noise) = (0.0, 0.0, 0.0);
    for sample in observed.used() {
        let added = if window.samples().contains(&sample) { added(sample) } else { 0.0 };
        whole += error[sample].powi(2);
        left += (error[sample] - added).powi(2);
        noise += observed.uncertainty[joint].unlucky();
    }
    if left > noise { ((left - noise) / whole).sqrt() } else { 0.0 }
}

/// Whether the latency changes readings by more than the steps of the encoders.
fn is_beyond_steps(observed: &Observed<'_>, joints: &[usize], (steps, window): (u64, Window)) -> bool {
    joints.iter().any(|&joint| {
        let added = added(observed, joint, steps);
        let resolution = observed.uncertainty[joint].resolution;
        window.samples().any(|sample| added(sample).abs() > 2.0 * resolution)
    })
}

/// A time as index of the sample before it, and the part of the way to the next one.
fn position_in_time(times_s: &[f64], time_s: f64) -> (usize, f64) {
    /// A time this near to a sample, as a part of the way, is the sample's.
    const AT_SAMPLE: f64 = 1e-6;
    let after = times_s.partition_point(|&known| known <= time_s);
    let before = after.saturating_sub(1);
    let next = (before + 1).min(times_s.len() - 1);
    let way = times_s[next] - times_s[before];
    let part = if way > 0.0 { ((time_s - times_s[before]) / way).clamp(0.0, 1.0) } else { 0.0 };
    let part = if part < AT_SAMPLE {
        0.0
    } else if part > 1.0 - AT_SAMPLE {
        1.0
    } else {
        part
    };
    (before, part)
}

fn interpolated(series: &[f64], (before, part): (usize, f64)) -> f64 {
    let next = (before + 1).min(series.len() - 1);
    series[before] + part * (series[next] - series[before])
}
