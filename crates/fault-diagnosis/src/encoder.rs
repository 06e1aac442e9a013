//! Hypotheses on encoders: measured position against the position by the poses of the links, joint by joint.

use congruent_scenario::{FaultKind, FaultQuantity, RunFault};

use super::{
    fit::{EXPLAINED, FaultFit, Window},
    observed::ObservedRun,
    shape::{self, FittedShape, ShapeTerm},
};

/// Evidence for a fault, in variances of the noise that it explains: by chance, the best of all beginnings and ends in a run
/// without a fault explains 25 at most.
pub(super) const SIGNIFICANT: f64 = 40.0;
/// Two hypotheses whose residuals differ by less than this many variances cannot be distinguished: four standard deviations.
pub(super) const DISTINCT: f64 = 16.0;

/// The faults of the encoders of some joints.
#[derive(Debug, Default)]
pub(super) struct EncoderFaults {
    pub(super) found: Vec<FaultFit>,
    /// Variances of the noise that they explain.
    pub(super) gain: f64,
    /// Joints for which noise makes several hypotheses possible, with these.
    pub(super) hidden: Vec<(usize, Vec<FaultFit>)>,
}

/// A hypothesis on one encoder, or on two of which it is one.
struct EncoderHypothesis {
    fit: FaultFit,
    /// Sum of the squares that it explains.
    gain: f64,
    /// Sum of the squares of the residual.
    residual: f64,
}

/// The faults of encoders of `joints`.
pub(super) fn faults(observed: &ObservedRun<'_>, joints: &[usize]) -> EncoderFaults {
    let mut faults = EncoderFaults::default();
    let mut open = joints.to_vec();
    // Pairs first: two exchanged encoders would otherwise be two faults with wrong values.
    for (at, &a) in joints.iter().enumerate() {
        for &b in &joints[at + 1..] {
            // Part of a pair that was found already.
            if !open.contains(&a) || !open.contains(&b) {
                continue;
            }
            if let Some((fit, gain)) = swapped(observed, a, b) {
                open.retain(|&joint| joint != a && joint != b);
                faults.gain += gain;
                faults.found.push(fit);
            }
        }
    }
    for joint in open {
        let mut hypotheses = alone(observed, joint);
        hypotheses.sort_by(|a, b| a.residual.total_cmp(&b.residual));
        let Some(best) = hypotheses.first() else { continue };
        // Noise in four standard deviations, and the mean square of rounding to steps, r^2 / 12, over all samples.
        let margin = observed.uncertainty[joint].evidence(DISTINCT, 0.0)
            + observed.uncertainty[joint].resolution.powi(2) * count(observed.samples()) / 12.0;
        if hypotheses.iter().any(|other| {
            other.fit.fault.kind != best.fit.fault.kind && other.residual < best.residual + margin
        }) {
            faults.hidden.push((joint, hypotheses.into_iter().map(|hypothesis| hypothesis.fit).collect()));
        } else {
            // In variances, so that gains of joints in rad and in m add up.
            faults.gain += best.gain / observed.uncertainty[joint].variance();
            faults.found.extend(hypotheses.into_iter().next().map(|hypothesis| hypothesis.fit));
        }
    }
    faults
}

#[expect(clippy::cast_precision_loss, reason = "samples are few")]
fn count(samples: usize) -> f64 {
    samples as f64
}

/// Whether readings are farther from the position than noise and resolution explain.
pub(super) fn is_wrong(observed: &ObservedRun<'_>, joint: usize) -> bool {
    /// One reading may be an outlier of the noise.
    const FEWEST: usize = 3;
    let largest = observed.uncertainty[joint].largest();
    observed.used().filter(|&sample| observed.error[joint][sample].abs() > largest).take(FEWEST).count()
        == FEWEST
}

/// A hypothesis that adds a series to the readings of a joint, if it explains their error.
fn hypothesis(
    observed: &ObservedRun<'_>,
    joint: usize,
    series: &[f64],
    how: ShapeTerm,
    fault: impl Fn(&FittedShape) -> RunFault,
) -> Option<EncoderHypothesis> {
    let uncertainty = observed.uncertainty[joint];
    let error = &observed.error[joint];
    let negligible = uncertainty.evidence(DISTINCT, 0.0);
    let shape = shape::fit(error, &observed.is_used, series, how, negligible)?;
    let (mut whole, mut residual, mut used) = (0.0, 0.0, 0.0);
    for sample in observed.used() {
        whole += error[sample].powi(2);
        residual += (error[sample] - shape.at(series, sample)).powi(2);
        used += 1.0;
    }
    // What noise in the worst case would leave over is no evidence against the hypothesis.
    let beyond = (residual - used * uncertainty.unlucky()).max(0.0);
    // Computed again from the residuals: the gain of the shape is a difference of sums over the whole run, whose rounding may
    // exceed the evidence that is required.
    let gain = whole - residual;
    let is_significant = gain > uncertainty.evidence(SIGNIFICANT, count(shape.window.len()));
    if !is_significant || beyond > EXPLAINED.powi(2) * whole {
        return None;
    }
    let fit = FaultFit { fault: fault(&shape), remaining: (beyond / whole).sqrt(), parameters: 1 };
    Some(EncoderHypothesis { fit, gain, residual })
}

fn fault(
    observed: &ObservedRun<'_>,
    kind: FaultKind,
    joints: &[usize],
    values: Vec<FaultQuantity>,
    window: Window,
) -> RunFault {
    let (from_s, until_s) = observed.times(window);
    let joints = joints.iter().map(|&joint| observed.name(joint)).collect();
    RunFault { kind, joints, link: None, values, from_s, until_s }
}

/// Both encoders read the other joint, counted from the beginning of the fault; with the variances that this explains.
fn swapped(observed: &ObservedRun<'_>, a: usize, b: usize) -> Option<(FaultFit, f64)> {
    let reads_other = |joint: usize, other: usize| {
        let (own, read) = (&observed.q[joint], &observed.q[other]);
        let series: Vec<f64> = read.iter().zip(own).map(|(read, own)| read - own).collect();
        let described = |shape: &FittedShape| {
            fault(observed, FaultKind::SwappedJoints, &[joint, other], Vec::new(), shape.window)
        };
        hypothesis(observed, joint, &series, ShapeTerm::OnceFromBegin, described)
    };
    let (mut first, second) = (reads_other(a, b)?, reads_other(b, a)?);
    let gain = |joint: usize, of: &EncoderHypothesis| of.gain / observed.uncertainty[joint].variance();
    let gain = gain(a, &first) + gain(b, &second);
    let (fault, other) = (&mut first.fit.fault, &second.fit.fault);
    fault.from_s = fault.from_s.min(other.from_s);
    // The fault lasts as long as either encoder shows it; without an end if one of them has none.
    fault.until_s = fault.until_s.zip(other.until_s).map(|(a, b)| a.max(b));
    first.fit.remaining = first.fit.remaining.max(second.fit.remaining);
    Some((first.fit, gain))
}

/// Hypotheses on one encoder that explain its error.
fn alone(observed: &ObservedRun<'_>, joint: usize) -> Vec<EncoderHypothesis> {
    let unit = observed.unit(joint);
    let described = |kind: FaultKind, values: Vec<FaultQuantity>, shape: &FittedShape| {
        fault(observed, kind, &[joint], values, shape.window)
    };
    let constant = vec![1.0; observed.samples()];
    let offset = hypothesis(observed, joint, &constant, ShapeTerm::Whole, |shape| {
        described(FaultKind::EncoderOffset, vec![FaultQuantity::offset(shape.factor, unit)], shape)
    });
    let drift = hypothesis(observed, joint, &observed.times_s, ShapeTerm::FromBegin, |shape| {
        described(FaultKind::EncoderDrift, vec![FaultQuantity::rate(shape.factor, unit)], shape)
    });
    // Reading -(q - q0) + q0 instead of q: the error is -2 (q - q0), a slope of -2 over the position.
    let back: Vec<f64> = observed.q[joint].iter().map(|q| -2.0 * q).collect();
    let flipped = hypothesis(observed, joint, &back, ShapeTerm::OnceFromBegin, |shape| {
        described(FaultKind::FlippedAxis, Vec::new(), shape)
    });
    [offset, drift, flipped].into_iter().flatten().collect()
}
