//! Hypotheses on the transport from encoders to controller: readings arrive late, or not at all.

use congruent_scenario::{FaultKind, FaultQuantity, RunFault};

use super::{
    encoder::{self, DISTINCT, SIGNIFICANT},
    fit::{EXPLAINED, FaultFit, Window, rms},
    noise::ROUNDING,
    observed::ObservedRun,
};

/// Readings that were lost on their path to the controller, which then has the one before again.
pub(super) struct Dropped {
    pub(super) fit: FaultFit,
    /// Whether the reading of a sample was lost.
    pub(super) is_held: Vec<bool>,
    /// Whether a loss would show in a sample: in the others a repeated reading is also a correct one.
    pub(super) would_show: Vec<bool>,
}

/// Readings that repeat the one before to the last bit in every joint although that would not happen by chance.
pub(super) fn dropped(observed: &ObservedRun<'_>, joints: &[usize]) -> Option<Dropped> {
    /// Chance of a repetition below which it is one of a reading that got lost.
    const CHANCE: f64 = 1e-6;
    let shows_loss = |sample: usize| {
        sample > 0
            && observed.are_consecutive(sample - 1, sample)
            && joints.iter().map(|&joint| repeats_by_chance(observed, joint, sample)).product::<f64>()
                < CHANCE
    };
    let repeats = |sample: usize| {
        // All joints: a transport loses whole messages.
        observed.measured.iter().all(|q| sample > 0 && q[sample].to_bits() == q[sample - 1].to_bits())
    };
    let shows_loss: Vec<bool> = (0..observed.samples()).map(shows_loss).collect();
    let window = Window::spanning(observed.samples(), |sample| shows_loss[sample] && repeats(sample))?;
    let showing = || window.samples().filter(|&sample| shows_loss[sample]);
    #[expect(clippy::cast_precision_loss, reason = "samples are few")]
    let (lost, all) = (showing().filter(|&sample| repeats(sample)).count() as f64, showing().count() as f64);
    // If all readings repeat, the first one stays: that is a latency from the start, not a loss of some.
    if lost >= all {
        return None;
    }
    let errors = |of_repeats: bool| {
        let samples = showing().filter(move |&sample| repeats(sample) == of_repeats);
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
    // Also where a loss would not show: a joint that settles moves by less than what shows a loss, and by more than rounding in
    // several lost readings.
    let is_held = (0..observed.samples()).map(|sample| sample >= window.first && repeats(sample)).collect();
    let fault = fault(observed, FaultKind::DroppedSamples, value, window, joints);
    let fit = FaultFit { fault, remaining, parameters: 1 };
    Some(Dropped { fit, is_held, would_show: shows_loss })
}

/// A bound of the chance that a reading repeats the one before.
fn repeats_by_chance(observed: &ObservedRun<'_>, joint: usize, sample: usize) -> f64 {
    let uncertainty = observed.uncertainty[joint];
    let (q, noise) = (&observed.q[joint], uncertainty.noise);
    let late = observed.late.map_or(0, |(_, steps)| steps);
    let Some(then) = sample.checked_sub(late).filter(|then| *then > 0) else { return 1.0 };
    // With a latency a reading is that of an earlier time, so the joint must have moved at both times to exclude a repetition.
    let moved = (q[sample] - q[sample - 1]).abs().min((q[then] - q[then - 1]).abs());
    // 10 / sqrt(2) = 7 standard deviations of the difference of two readings.
    if moved > uncertainty.resolution + 10.0 * noise + ROUNDING {
        return 0.0;
    }
    if noise <= ROUNDING {
        return 1.0;
    }
    // Density of the difference of two normal numbers at zero, 1 / (2 sqrt(pi) s), times the width of two steps; without a
    // resolution the step is that of a double.
    (uncertainty.resolution.max(f64::EPSILON) / (std::f64::consts::PI.sqrt() * noise)).min(1.0)
}

fn fault(
    observed: &ObservedRun<'_>,
    kind: FaultKind,
    value: FaultQuantity,
    window: Window,
    joints: &[usize],
) -> RunFault {
    let (from_s, until_s) = observed.times_in_motion(window, joints);
    RunFault { kind, joints: Vec::new(), link: None, values: vec![value], from_s, until_s }
}

/// Readings of an earlier time.
pub(super) struct Late {
    pub(super) fit: FaultFit,
    pub(super) window: Window,
    pub(super) steps: usize,
    /// Joints whose error has another part, which the latency does not explain.
    pub(super) others: Vec<usize>,
    /// Variances of the noise that it explains.
    gain: f64,
}

impl Late {
    /// Variances of the noise that the latency explains, and faults of encoders beside it.
    pub(super) fn gain_with_others(&self, observed: &ObservedRun<'_>) -> f64 {
        if self.others.is_empty() {
            return self.gain;
        }
        // Of the other joints what the latency takes away, and what faults of their encoders take of the rest.
        let of_others: f64 =
            self.others.iter().map(|&joint| gained(observed, joint, self.steps as u64, self.window)).sum();
        self.gain + of_others + encoder::faults(&self.taken_out(observed), &self.others).gain
    }

    /// The run with the errors that the latency does not explain.
    pub(super) fn taken_out<'a>(&self, observed: &ObservedRun<'a>) -> ObservedRun<'a> {
        let mut error: Vec<Vec<f64>> = observed.error.iter().map(|error| vec![0.0; error.len()]).collect();
        for &joint in &self.others {
            let added = added(observed, joint, self.steps as u64);
            error[joint].copy_from_slice(&observed.error[joint]);
            for sample in self.window.samples() {
                error[joint][sample] -= added(sample);
            }
        }
        ObservedRun { error, ..observed.clone() }
    }
}

/// All readings are those of an earlier time; the encoders of a minority of joints may be off as well.
pub(super) fn late(observed: &ObservedRun<'_>, joints: &[usize]) -> Option<Late> {
    let (steps, (window, _)) = best_latency(observed, joints)?;
    let rest = |steps: u64, window: Window| -> Vec<usize> {
        let has_more = |joint: &usize| remaining(observed, *joint, steps, window) > EXPLAINED;
        joints.iter().copied().filter(has_more).collect()
    };
    let mut best = (rest(steps, window), steps);
    if !best.0.is_empty() {
        // An encoder that is off as well draws the common latency to another value: each joint is fitted by itself.
        let alone = joints.iter().filter_map(|joint| best_latency(observed, std::slice::from_ref(joint)));
        let alone = alone.map(|(steps, (window, _))| (rest(steps, window), steps));
        best = alone.chain([best]).min_by_key(|(others, _)| others.len())?;
    }
    let (others, steps) = best;
    let own: Vec<usize> = joints.iter().copied().filter(|joint| !others.contains(joint)).collect();
    // A latency is of all readings: what explains only a few of them is another fault.
    if 2 * others.len() >= joints.len().max(1) {
        return None;
    }
    let (window, gain) = shifted(observed, &own, steps);
    let remaining = own.iter().map(|&joint| remaining(observed, joint, steps, window)).fold(0.0, f64::max);
    // Steps of encoders are within their readings' uncertainty, however well a latency repeats their pattern.
    let is_wrong = own.iter().any(|&joint| encoder::is_wrong(observed, joint));
    let is_significant = gain > SIGNIFICANT
        && remaining <= EXPLAINED
        && is_wrong
        && is_beyond_steps(observed, &own, steps, window);
    #[expect(clippy::cast_precision_loss, reason = "steps of a run are far below 2^52")]
    let value = FaultQuantity::latency(steps as f64 * observed.clock.step_s);
    let fault = fault(observed, FaultKind::Latency, value, window, joints);
    let fit = FaultFit { fault, remaining, parameters: 1 };
    is_significant.then_some(Late { fit, window, steps: usize::try_from(steps).ok()?, others, gain })
}

/// The latency, in steps, that explains most of the errors of some joints, with its window and gain.
fn best_latency(observed: &ObservedRun<'_>, joints: &[usize]) -> Option<(u64, (Window, f64))> {
    // A geometric grid, then bisection of the distance around the best: each trial costs a pass over all samples, and the gain
    // has one broad maximum at the right latency.
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
    Some(best)
}

/// The error that a latency adds to the reading of every sample.
fn added(observed: &ObservedRun<'_>, joint: usize, steps: u64) -> impl Fn(usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "steps of a run are far below 2^52")]
    let latency_s = steps as f64 * observed.clock.step_s;
    let (q, times_s) = (&observed.q[joint], &observed.times_s);
    move |sample| {
        let (before, part) = position_in_time(times_s, times_s[sample] - latency_s);
        interpolated(q, before, part) - q[sample]
    }
}

/// By how much a latency in a window lowers the sum of squares of a joint, in variances; below 0 if it raises it.
fn gained(observed: &ObservedRun<'_>, joint: usize, steps: u64, window: Window) -> f64 {
    let (error, added) = (&observed.error[joint], added(observed, joint, steps));
    let used = observed.used().filter(|sample| window.samples().contains(sample));
    let gains = used.map(|sample| lowered(error[sample], added(sample)));
    gains.sum::<f64>() / observed.uncertainty[joint].variance()
}

/// `e^2 - (e - a)^2`, by which an added `a` lowers the square of an error.
fn lowered(error: f64, added: f64) -> f64 {
    added * (2.0 * error - added)
}

/// The window in which a latency explains most, in variances: the largest sum of successive gains (Kadane's algorithm).
fn shifted(observed: &ObservedRun<'_>, joints: &[usize], steps: u64) -> (Window, f64) {
    let mut gains = vec![0.0; observed.samples()];
    for &joint in joints {
        let (error, added) = (&observed.error[joint], added(observed, joint, steps));
        let variance = observed.uncertainty[joint].variance();
        for sample in observed.used() {
            gains[sample] += lowered(error[sample], added(sample)) / variance;
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
    // To the end of the run, unless the samples after the window speak against the latency distinctly.
    if gains[best.0.end..].iter().sum::<f64>() > -DISTINCT {
        best.0.end = gains.len();
    }
    best
}

/// Relative residual of a joint with a latency, beyond noise.
fn remaining(observed: &ObservedRun<'_>, joint: usize, steps: u64, window: Window) -> f64 {
    let (error, added) = (&observed.error[joint], added(observed, joint, steps));
    let (mut whole, mut residual, mut noise) = (0.0, 0.0, 0.0);
    for sample in observed.used() {
        let added = if window.samples().contains(&sample) { added(sample) } else { 0.0 };
        whole += error[sample].powi(2);
        residual += (error[sample] - added).powi(2);
        noise += observed.uncertainty[joint].unlucky();
    }
    if residual > noise { ((residual - noise) / whole).sqrt() } else { 0.0 }
}

/// Whether the latency changes readings by more than the steps of the encoders.
fn is_beyond_steps(observed: &ObservedRun<'_>, joints: &[usize], steps: u64, window: Window) -> bool {
    joints.iter().any(|&joint| {
        let added = added(observed, joint, steps);
        let resolution = observed.uncertainty[joint].resolution;
        window.samples().any(|sample| added(sample).abs() > 2.0 * resolution)
    })
}

/// A time as index of the sample before it, and the part of the interval to the next one.
fn position_in_time(times_s: &[f64], time_s: f64) -> (usize, f64) {
    /// A time this near to a sample, as a part of the interval, is the sample's.
    const AT_SAMPLE: f64 = 1e-6;
    let after = times_s.partition_point(|&known| known <= time_s);
    let before = after.saturating_sub(1);
    let next = (before + 1).min(times_s.len() - 1);
    let interval_s = times_s[next] - times_s[before];
    // Rounding of times: a latency of whole steps has to give readings, not interpolations between them.
    let part = if interval_s > 0.0 { ((time_s - times_s[before]) / interval_s).clamp(0.0, 1.0) } else { 0.0 };
    let part = if part < AT_SAMPLE {
        0.0
    } else if part > 1.0 - AT_SAMPLE {
        1.0
    } else {
        part
    };
    (before, part)
}

fn interpolated(series: &[f64], before: usize, part: f64) -> f64 {
    let next = (before + 1).min(series.len() - 1);
    series[before] + part * (series[next] - series[before])
}
