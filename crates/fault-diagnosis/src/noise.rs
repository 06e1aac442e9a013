//! How far the readings of an encoder may be from the position without a fault, from the samples alone.

/// Smaller differences of a joint's position are rounding of the poses, rad and m. Worst seen 6e-15 for arms of seven joints; an
/// encoder of 32 bits has steps of 1.5e-9.
pub(super) const ROUNDING: f64 = 1e-10;

/// Readings without a fault stay within this many standard deviations: one of 5e8 does not.
const DEVIATIONS: f64 = 6.0;
/// Factor by which the estimate of a variance may be too small: a fifth above the largest that 1000 samples give.
const ESTIMATE: f64 = 1.25;

/// Noise and resolution of one encoder, rad or m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Uncertainty {
    /// Standard deviation of what changes at random from sample to sample.
    pub(super) noise: f64,
    /// Steps of the readings; zero for one that follows.
    pub(super) resolution: f64,
}

impl Uncertainty {
    /// Largest distance of a reading from the position.
    pub(super) fn largest(self) -> f64 {
        DEVIATIONS * self.noise + self.resolution + ROUNDING
    }

    /// Expected square of the distance.
    pub(super) fn variance(self) -> f64 {
        self.noise.powi(2) + self.resolution.powi(2) / 12.0 + ROUNDING.powi(2)
    }

    /// Mean square of the distance in the worst case: a joint at rest between two steps of its encoder has an error of half a
    /// step in every sample.
    pub(super) fn unlucky(self) -> f64 {
        ESTIMATE * self.noise.powi(2) + self.resolution.powi(2) / 4.0 + ROUNDING.powi(2)
    }

    /// Least evidence for a fault that shows in `samples` readings: squares that it explains. A mean within a step is none.
    pub(super) fn evidence(self, deviations_squared: f64, samples: f64) -> f64 {
        deviations_squared * (self.noise.powi(2) + ROUNDING.powi(2)) + samples * self.resolution.powi(2)
    }
}

/// The resolution of readings, if they have steps: readings repeat at times while the joint moves, and all changes are
/// multiples of the smallest.
pub(super) fn resolution(q: &[f64], measured: &[f64]) -> Option<f64> {
    /// Rounding of a multiple, as a part of a step.
    const MULTIPLE: f64 = 1e-3;
    let changes =
        |series: &[f64]| series.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect::<Vec<f64>>();
    let (moved, read) = (changes(q), changes(measured));
    // Without a repetition while the joint moves, equal changes are those of an even motion, not steps.
    let repeats = moved.iter().zip(&read).any(|(moved, read)| *moved > ROUNDING && *read <= 0.0);
    let smallest = read.iter().copied().filter(|change| *change > 0.0).fold(f64::INFINITY, f64::min);
    let is_multiple = |change: &f64| (change / smallest - (change / smallest).round()).abs() < MULTIPLE;
    (repeats && smallest.is_finite() && read.iter().all(is_multiple)).then_some(smallest)
}

/// The standard deviation of the noise in a series of errors, by the median of its second differences, to which a fault adds
/// little. `is_in_triple` selects the samples that directly follow two others, without repetitions.
pub(super) fn noise(error: &[f64], is_in_triple: impl Fn(usize) -> bool) -> f64 {
    /// Median of the size of a normal variable.
    const MEDIAN: f64 = 0.6745;
    /// Second differences of noise turn three times of four, those of a motion seldom.
    const SELDOM: f64 = 0.4;
    let triples = (2..error.len()).filter(|&sample| is_in_triple(sample));
    let mut second: Vec<f64> =
        triples.map(|sample| error[sample] - 2.0 * error[sample - 1] + error[sample - 2]).collect();
    if second.is_empty() {
        return 0.0;
    }
    let turns = second.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).count();
    // A smooth error, such as that of a latency, has second differences as well, but they seldom change sign: not noise.
    #[expect(clippy::cast_precision_loss, reason = "samples are few")]
    if (turns as f64) < SELDOM * second.len() as f64 {
        return 0.0;
    }
    for difference in &mut second {
        *difference = difference.abs();
    }
    second.sort_by(f64::total_cmp);
    // The variance of a second difference is 1 + 4 + 1 times that of the noise.
    // The median: differences at the beginning and end of a fault are large, but few.
    second[second.len() / 2] / (MEDIAN * 6.0_f64.sqrt())
}
