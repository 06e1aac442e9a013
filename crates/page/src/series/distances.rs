//! The smallest distances over time. They are measured now and then: an exact distance costs more than a physics step.

use congruent_monitors::{JudgedPairs, Sample};
use congruent_proximity::Nearest;
use congruent_scenario::Check;

use super::{
    buckets::single,
    plots::{Floats, PlotLine},
};

/// Least time between two measurements, a multiple of the period of recordings, which have then measured already.
/// Unit: s.
const PERIOD_S: f64 = 0.02;
/// Most instants at which distances are measured in a run. Kind: choice, a plot has no more points.
const MOST: u64 = 400;
/// Room for the braking after a stop, which follows the end of the run, and for the last instant.
const ROOM: usize = 1000;

/// The smallest distance at some instants, and between which two.
#[derive(Debug, Clone, Default)]
pub(crate) struct NearestSeries {
    times_s: Vec<f32>,
    values_m: Vec<f32>,
    pairs: Vec<usize>,
}

impl NearestSeries {
    fn with_capacity(rows: usize) -> Self {
        Self {
            times_s: Vec::with_capacity(rows),
            values_m: Vec::with_capacity(rows),
            pairs: Vec::with_capacity(rows),
        }
    }

    /// The line of a plot, each value with the name of its pair; `None` if there is no pair.
    pub(crate) fn line(&self, name: &str, names: &[String]) -> Option<PlotLine> {
        let mut subjects: Vec<usize> = Vec::new();
        // Each name once: the page carries an index for each value instead of a name.
        let of_pair = |pair: &usize| {
            subjects.iter().position(|known| known == pair).unwrap_or_else(|| {
                subjects.push(*pair);
                subjects.len() - 1
            })
        };
        let of_values: Vec<usize> = self.pairs.iter().map(of_pair).collect();
        (!self.pairs.is_empty()).then(|| PlotLine {
            name: name.to_owned(),
            values: Floats(self.values_m.clone()),
            times_s: Some(Floats(self.times_s.clone())),
            subjects: of_values,
            subject_names: subjects.iter().map(|&pair| names[pair].clone()).collect(),
            ..PlotLine::default()
        })
    }

    fn push(&mut self, time_s: f64, nearest: Option<Nearest>) {
        let Some(Nearest { distance_m, pair }) = nearest else { return };
        self.times_s.push(single(time_s));
        self.values_m.push(single(distance_m));
        self.pairs.push(pair);
    }
}

/// Distances between links and to obstacles, and from links to the zones that are forbidden to them.
#[derive(Debug)]
pub(crate) struct NearestOverTime {
    /// Steps between two measurements.
    stride: u64,
    judged: JudgedPairs,
    pub(crate) clearance: NearestSeries,
    pub(crate) zones: NearestSeries,
}

impl NearestOverTime {
    /// For a run of this number of steps: the distances that its checks judge.
    pub(crate) fn new(checks: &[Check], step_s: f64, steps: u64) -> Self {
        Self {
            stride: stride(step_s, steps),
            judged: JudgedPairs::new(checks),
            clearance: NearestSeries::with_capacity(ROOM),
            zones: NearestSeries::with_capacity(ROOM),
        }
    }

    /// Measures at this instant, if the stride has come to it.
    pub(crate) fn observe(&mut self, sample: &mut Sample<'_>) {
        if sample.step.is_multiple_of(self.stride) || sample.is_last {
            self.clearance.push(sample.time_s, self.judged.nearest(sample.clearance));
            self.zones.push(sample.time_s, sample.zones.nearest());
        }
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a step is positive, and the cast of floats saturates"
)]
fn stride(step_s: f64, steps: u64) -> u64 {
    let at_least = ((PERIOD_S / step_s).round() as u64).max(1);
    // A multiple of the least stride: at these steps the recording has measured the distances already.
    at_least * steps.div_ceil(MOST.saturating_mul(at_least)).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_more_than_fifty_looks_a_second_and_four_hundred_in_all() {
        assert_eq!(stride(0.001, 4000), 20);
        assert_eq!(stride(0.001, 600_000), 1500);
        assert_eq!(stride(0.05, 10), 1);
    }
}
