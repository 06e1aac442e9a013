//! The smallest distances over time. They are measured now and then: an exact distance costs more than a physics step.
//! Links that are near because the arm is built that way are kept apart from what comes near.

use congruent_description::RobotDescription;
use congruent_monitors::{JudgedPairs, Sample};
use congruent_proximity::{Clearance, Nearest, Pair};
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

/// Nearest pairs that are kept at each instant: those that never change are left out of a plot, and so many stay at most.
const KEPT: usize = 4;
/// A distance that varies by no more is constant in a run. Kind: choice; contact of hulls of a mesh varies by less. Unit: m.
const CONSTANT_M: f64 = 1e-4;

/// The nearest pairs of one instant, the nearest first.
type NearestFew = [Option<Nearest>; KEPT];

/// The nearest pairs at some instants.
#[derive(Debug, Clone, Default)]
pub(crate) struct NearestSeries {
    times_s: Vec<f32>,
    nearest: Vec<NearestFew>,
}

/// A pair that has the same distance at every instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ConstantPair {
    pub(crate) pair: usize,
    pub(crate) distance_m: f64,
}

impl NearestSeries {
    fn with_capacity(rows: usize) -> Self {
        Self { times_s: Vec::with_capacity(rows), nearest: Vec::with_capacity(rows) }
    }

    /// Measures the nearest pairs of those that are chosen.
    fn measure(&mut self, time_s: f64, distances: &mut Clearance, is_chosen: impl Fn(usize, Pair) -> bool) {
        let mut found: NearestFew = [None; KEPT];
        for at in 0..KEPT {
            let (before, _) = found.split_at(at);
            let is_new = |pair: usize| !before.iter().flatten().any(|known| known.pair == pair);
            let next =
                distances.nearest_of(f64::INFINITY, |index, pair| is_chosen(index, pair) && is_new(index));
            found[at] = next;
        }
        if found[0].is_some() {
            self.times_s.push(single(time_s));
            self.nearest.push(found);
        }
    }

    /// The pairs that were among the nearest all the time and kept their distance, the nearest first.
    pub(crate) fn constant(&self) -> Vec<ConstantPair> {
        // At a single instant nothing can change.
        let (Some(first), true) = (self.nearest.first(), self.nearest.len() > 1) else { return Vec::new() };
        let is_constant = |candidate: &&Nearest| {
            self.nearest.iter().all(|few| {
                let same = few.iter().flatten().find(|other| other.pair == candidate.pair);
                same.is_some_and(|other| (other.distance_m - candidate.distance_m).abs() <= CONSTANT_M)
            })
        };
        let found = first.iter().flatten().filter(is_constant);
        found.map(|of| ConstantPair { pair: of.pair, distance_m: of.distance_m }).collect()
    }

    /// The line of a plot, each value with the name of its pair: the nearest that does not keep its distance. `None` if there
    /// is none.
    pub(crate) fn line(&self, name: &str, names: &[String]) -> Option<PlotLine> {
        let constant = self.constant();
        let can_change = |of: &&Nearest| !constant.iter().any(|constant| constant.pair == of.pair);
        let mut subjects: Vec<usize> = Vec::new();
        // Each name once: the page carries an index for each value instead of a name.
        let mut index_of = |pair: usize| {
            subjects.iter().position(|&known| known == pair).unwrap_or_else(|| {
                subjects.push(pair);
                subjects.len() - 1
            })
        };
        let (mut times_s, mut values_m, mut of_values) = (Vec::new(), Vec::new(), Vec::new());
        for (time_s, few) in self.times_s.iter().zip(&self.nearest) {
            let Some(nearest) = few.iter().flatten().find(can_change) else { continue };
            times_s.push(*time_s);
            values_m.push(single(nearest.distance_m));
            of_values.push(index_of(nearest.pair));
        }
        (!values_m.is_empty()).then(|| PlotLine {
            name: name.to_owned(),
            values: Floats(values_m),
            times_s: Some(Floats(times_s)),
            subjects: of_values,
            subject_names: subjects.iter().map(|&pair| names[pair].clone()).collect(),
            ..PlotLine::default()
        })
    }
}

/// Distances between links and to obstacles, and from links to the zones that are forbidden to them.
#[derive(Debug)]
pub(crate) struct NearestOverTime {
    /// Steps between two measurements.
    stride: u64,
    judged: JudgedPairs,
    /// For each pair whether no motion at all changes its distance; empty before the first instant.
    is_built: Vec<bool>,
    pub(crate) links: NearestSeries,
    pub(crate) obstacles: NearestSeries,
    pub(crate) zones: NearestSeries,
}

impl NearestOverTime {
    /// For a run of this number of steps: the distances that its checks judge.
    pub(crate) fn new(checks: &[Check], step_s: f64, steps: u64) -> Self {
        Self {
            stride: stride(step_s, steps),
            judged: JudgedPairs::new(checks),
            is_built: Vec::new(),
            links: NearestSeries::with_capacity(ROOM),
            obstacles: NearestSeries::with_capacity(ROOM),
            zones: NearestSeries::with_capacity(ROOM),
        }
    }

    /// Measures at this instant, if the stride has come to it.
    pub(crate) fn observe(&mut self, sample: &mut Sample<'_>, description: &RobotDescription) {
        if !sample.step.is_multiple_of(self.stride) && !sample.is_last {
            return;
        }
        // It also decides which pairs are judged.
        self.judged.nearest(sample.clearance);
        if self.is_built.len() != sample.clearance.pairs().len() {
            self.is_built = sample.clearance.constant_pairs(description);
        }
        let (links, judged) = (sample.twin.len(), &self.judged);
        let between_links = |index: usize, pair: Pair| pair.b < links && judged.contains(index);
        self.links.measure(sample.time_s, sample.clearance, between_links);
        let to_obstacles = |index: usize, pair: Pair| pair.b >= links && judged.contains(index);
        self.obstacles.measure(sample.time_s, sample.clearance, to_obstacles);
        self.zones.measure(sample.time_s, sample.zones, |_, _| true);
    }

    /// Why the distance of a pair never changes, in words; `None` if it does.
    pub(crate) fn why_constant(&self, pair: usize) -> Option<&'static str> {
        if self.is_built.get(pair).is_some_and(|is_built| *is_built) {
            return Some("constant: built that way");
        }
        let mut constant = self.links.constant().into_iter().chain(self.obstacles.constant());
        constant.any(|of| of.pair == pair).then_some("constant in this run")
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
    fn a_pair_that_keeps_its_distance_is_not_plotted() {
        let near = |pair: usize, distance_m: f64| Some(Nearest { distance_m, pair });
        let series = NearestSeries {
            times_s: vec![0.0, 1.0, 2.0],
            nearest: vec![
                [near(7, 0.03), near(2, 0.5), None, None],
                [near(7, 0.03), near(2, 0.2), near(5, 0.9), None],
                [near(5, 0.01), near(7, 0.030_01), near(2, 0.1), None],
            ],
        };
        assert_eq!(series.constant(), [ConstantPair { pair: 7, distance_m: 0.03 }]);
        let names: Vec<String> = (0..8).map(|pair| format!("pair {pair}")).collect();
        let line = series.line("nearest", &names).unwrap();
        assert_eq!(
            (line.values.0, line.subject_names),
            (vec![0.5, 0.2, 0.01], vec![names[2].clone(), names[5].clone()])
        );
    }

    #[test]
    fn no_more_than_fifty_looks_a_second_and_four_hundred_in_all() {
        assert_eq!(stride(0.001, 4000), 20);
        assert_eq!(stride(0.001, 600_000), 1500);
        assert_eq!(stride(0.05, 10), 1);
    }
}
