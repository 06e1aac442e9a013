//! Hypotheses on the way from encoders to controller: readings arrive late, or not at all.

use super::{
    fit::{Fit, Window, rms},
    observed::{Observed, ROUNDING},
};
use crate::{
    fault::{FaultQuantity, RunFault},
    scenario::FaultKind,
};

/// Readings that repeat the one before to the last bit in every joint although the robot moves.
pub(super) fn dropped(observed: &Observed<'_>, joints: &[usize]) -> Option<Fit> {
    let moves = |sample: usize| {
        sample > 0
            && observed.are_consecutive(sample - 1, sample)
            && joints
                .iter()
                .any(|&joint| (observed.q[joint][sample] - observed.q[joint][sample - 1]).abs() > ROUNDING)
    };
    let repeats = |sample: usize| {
        moves(sample) && observed.measured.iter().all(|q| q[sample].to_bits() == q[sample - 1].to_bits())
    };
    let window = Window::of(observed.samples(), repeats)?;
    // What a lost reading leaves behind; a sensor with coarse steps differs at the others as well.
    let errors = |of_repeats: bool| {
        let samples = window.samples().filter(move |&sample| moves(sample) && repeats(sample) == of_repeats);
        rms(samples.flat_map(|sample| joints.iter().map(move |&joint| observed.error[joint][sample])))
    };
    let remaining = errors(false) / errors(true);
    #[expect(clippy::cast_precision_loss, reason = "samples are few")]
    let count = |is: &dyn Fn(usize) -> bool| window.samples().filter(|&sample| is(sample)).count() as f64;
    let (lost, all) = (count(&repeats), count(&moves));
    // At the begin of a latency readings repeat as well, all of them for its time.
    if lost >= all {
        return None;
    }
    let share = FaultQuantity::share(lost / all);
    Some(fit(observed, FaultKind::DroppedSamples, (share, window, joints), remaining))
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

/// All readings are those of an earlier time.
pub(super) fn late(observed: &Observed<'_>, joints: &[usize]) -> Option<Fit> {
    let is_off = |sample: usize| joints.iter().any(|&joint| observed.error[joint][sample].abs() > ROUNDING);
    let window = Window::of(observed.samples(), is_off)?;
    let whole = rms(window
        .samples()
        .flat_map(|sample| joints.iter().map(move |&joint| observed.error[joint][sample])));
    let left = |latency_s: f64| {
        let difference = |sample: usize| {
            let then = observed.times_s[sample] - latency_s;
            let at = position_in_time(&observed.times_s, then);
            joints
                .iter()
                .map(move |&joint| observed.measured[joint][sample] - interpolated(&observed.q[joint], at))
        };
        rms(window.samples().flat_map(difference)) / whole
    };
    // Readings arrive whole steps late: the first guess is the slope of the error over the speed.
    let step_s = observed.clock.step_s;
    let guess = (slope_over_speed(observed, joints, window)? / step_s).round();
    if guess < 1.0 {
        return None;
    }
    let around = [0.25, 0.5, 0.75, 0.9, 1.0, 1.1, 1.25, 1.5, 2.0, 3.0].map(|part| (guess * part).round());
    let near = |centre: f64| [-2.0, -1.0, 0.0, 1.0, 2.0].map(|shift| centre + shift);
    let best = |steps: &mut dyn Iterator<Item = f64>| {
        let fits = steps.filter(|&steps| steps >= 1.0).map(|steps| (steps, left(steps * step_s)));
        fits.min_by(|a, b| a.1.total_cmp(&b.1))
    };
    let (centre, _) = best(&mut around.into_iter())?;
    let (steps, remaining) = best(&mut near(centre).into_iter())?;
    let latency = FaultQuantity::latency(steps * step_s);
    Some(fit(observed, FaultKind::Latency, (latency, window, joints), remaining))
}

/// `tau` in `error = -tau speed`.
fn slope_over_speed(observed: &Observed<'_>, joints: &[usize], window: Window) -> Option<f64> {
    let (mut product, mut square) = (0.0, 0.0);
    for sample in window.samples().filter(|&sample| sample > 0) {
        let since_s = observed.times_s[sample] - observed.times_s[sample - 1];
        for &joint in joints {
            let speed = (observed.q[joint][sample] - observed.q[joint][sample - 1]) / since_s;
            product -= observed.error[joint][sample] * speed;
            square += speed * speed;
        }
    }
    (square > 0.0).then(|| product / square)
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
