//! How long samples wait for their answer, in memory that does not grow with them.

use schemars::JsonSchema;
use serde::Serialize;

/// Steps of the scale in each doubling of the time: shares are exact within 5 %.
const STEPS: f64 = 16.0;
/// Number of steps: from 1 us to 73 min.
const BINS: usize = 512;
const SHORTEST_S: f64 = 1e-6;

/// Times between the arrival of a sample and its answer.
#[derive(Debug, Clone)]
pub(super) struct Latency {
    counts: Vec<u64>,
    largest_s: f64,
}

/// How long samples waited for their answer: from the arrival of their message until all lines about it were written.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct LatencyReport {
    /// Samples that came while the run went on; those that came before its begin are not among them.
    pub samples: u64,
    /// Half of them waited no longer, within 5 %.
    pub median_s: f64,
    /// 99 of 100 waited no longer, within 5 %.
    pub p99_s: f64,
    /// The longest time.
    pub largest_s: f64,
}

impl Default for Latency {
    fn default() -> Self {
        Self { counts: vec![0; BINS], largest_s: 0.0 }
    }
}

impl Latency {
    pub(super) fn take(&mut self, seconds: f64) {
        let step = libm::log2(seconds.max(SHORTEST_S) / SHORTEST_S) * STEPS;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a small positive number"
        )]
        let bin = (step as usize).min(BINS - 1);
        self.counts[bin] += 1;
        self.largest_s = self.largest_s.max(seconds);
    }

    /// The report; `None` without a sample.
    pub(super) fn report(&self) -> Option<LatencyReport> {
        let samples: u64 = self.counts.iter().sum();
        (samples > 0).then(|| LatencyReport {
            samples,
            median_s: self.below(samples.div_ceil(2)),
            p99_s: self.below((samples * 99).div_ceil(100)),
            largest_s: self.largest_s,
        })
    }

    /// The time below which so many samples are.
    fn below(&self, wanted: u64) -> f64 {
        let mut seen = 0;
        for (bin, count) in self.counts.iter().enumerate() {
            seen += count;
            if seen >= wanted {
                #[expect(clippy::cast_precision_loss, reason = "at most 512")]
                let end = (bin + 1) as f64;
                return (SHORTEST_S * libm::exp2(end / STEPS)).min(self.largest_s);
            }
        }
        self.largest_s
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One step of the scale.
    const RELATIVE: f64 = 0.05;

    #[test]
    fn shares_are_those_of_the_times_within_a_step_of_the_scale() {
        let mut latency = Latency::default();
        assert_eq!(latency.report(), None);
        (1..=1000_u32).for_each(|number| latency.take(f64::from(number) * 1e-5));
        let report = latency.report().unwrap();
        let near = |found: f64, expected: f64| (found / expected - 1.0).abs() < RELATIVE;
        assert!(near(report.median_s, 5e-3) && near(report.p99_s, 9.9e-3), "{report:?}");
        assert_eq!((report.samples, report.largest_s), (1000, 1e-2));
    }
}
