//! The smallest distances over time. They are measured now and then: an exact distance costs more than a physics step. Between
//! two measurements only what comes much nearer is measured, so that no short approach is lost.
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
/// Time between two examinations of the links for what came nearer: no arm moves far in it. An obstacle on a path has any
/// speed, and is examined at every step. Unit: s; kind: choice, 10 mm at 2 m/s.
const LINKS_PERIOD_S: f64 = 0.005;
/// Most instants at which distances are measured in a run. Kind: choice, a plot has no more points.
const MOST: u64 = 400;
/// Room for the braking after a stop, which follows the end of the run, for the last instant, and for what comes near between
/// two measurements.
const ROOM: usize = 1600;
/// Between two measurements a distance is measured if it may be below this share of what is known of its pair. Kind: choice:
/// the smallest distance of each span is in the plot to 10 %.
const NEARER: f64 = 0.9;

/// Nearest pairs that are kept at each instant: those that never change are left out of a plot, and so many stay at most.
const KEPT: usize = 4;
/// Room for pairs that come nearer at one instant; more are kept, too.
const FOUND: usize = 64;
/// A distance that varies by no more is constant in a run. Kind: choice; contact of hulls of a mesh varies by less. Unit: m.
const CONSTANT_M: f64 = 1e-4;

/// The nearest pairs of one instant, the nearest first.
type NearestFew = [Option<Nearest>; KEPT];

/// The nearest pairs at some instants.
#[derive(Debug, Clone, Default)]
pub(crate) struct NearestSeries {
    times_s: Vec<f32>,
    nearest: Vec<NearestFew>,
    /// The smallest distances since the last measurement and when the last of them was found; `None` if nothing came nearer.
    between: Option<(f32, NearestFew)>,
    /// Room for the pairs that came nearer at one instant.
    found: Vec<Nearest>,
}

/// A pair that has the same distance at every instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ConstantPair {
    pub(crate) pair: usize,
    pub(crate) distance_m: f64,
}

impl NearestSeries {
    fn with_capacity(rows: usize) -> Self {
        Self {
            times_s: Vec::with_capacity(rows),
            nearest: Vec::with_capacity(rows),
            between: None,
            found: Vec::with_capacity(FOUND),
        }
    }

    /// The smallest distances since the last measurement, that included.
    fn latest(&self) -> Option<&NearestFew> {
        self.between.as_ref().map(|(_, few)| few).or(self.nearest.last())
    }

    /// The distance below which a pair has come nearer since the last measurement.
    fn nearer_m(&self, pair: usize) -> f64 {
        let Some(few) = self.latest() else { return f64::NEG_INFINITY };
        let known = few.iter().flatten().find(|known| known.pair == pair);
        // Of the other pairs only this is known: they are no nearer than the last of the nearest.
        let farthest = known.or_else(|| few.iter().flatten().last());
        farthest.map_or(f64::NEG_INFINITY, |known| NEARER * known.distance_m)
    }

    /// The largest of these distances.
    fn farthest_nearer_m(&self) -> f64 {
        let farthest = self.latest().and_then(|few| few.iter().flatten().last());
        farthest.map_or(f64::NEG_INFINITY, |farthest| NEARER * farthest.distance_m)
    }

    /// Measures those of the chosen pairs that may have come nearer since the last measurement.
    fn measure_nearer(&mut self, time_s: f64, distances: &mut Clearance, is_chosen: impl Fn(usize) -> bool) {
        let threshold_m = self.farthest_nearer_m();
        if threshold_m <= 0.0 {
            return;
        }
        let mut found = std::mem::take(&mut self.found);
        distances.below(
            threshold_m,
            |pair| if is_chosen(pair) { self.nearer_m(pair) } else { f64::NEG_INFINITY },
            |pair, distance_m| found.push(Nearest { distance_m, pair }),
        );
        for near in found.drain(..) {
            self.came_nearer(time_s, near);
        }
        self.found = found;
    }

    /// A pair that has come nearer since the last measurement.
    fn came_nearer(&mut self, time_s: f64, near: Nearest) {
        let Some(mut few) = self.latest().copied() else { return };
        // In the place of what was known of the pair, or else of the last.
        let known = few.iter().position(|known| known.is_none_or(|known| known.pair == near.pair));
        few[known.unwrap_or(KEPT - 1)] = Some(near);
        few.sort_by(|a, b| {
            let [a, b] = [a, b].map(|few| few.map_or(f64::INFINITY, |near| near.distance_m));
            a.total_cmp(&b)
        });
        self.between = Some((single(time_s), few));
    }

    /// Begins a new span: what came nearer in the last one is a value of its own, before that of the present instant.
    fn end_span(&mut self) {
        if let Some((time_s, few)) = self.between.take() {
            self.times_s.push(time_s);
            self.nearest.push(few);
        }
    }

    /// Measures the nearest pairs of those that are chosen.
    fn measure(&mut self, time_s: f64, distances: &mut Clearance, is_chosen: impl Fn(usize, Pair) -> bool) {
        self.end_span();
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
    /// Steps between two examinations of the links.
    links_stride: u64,
    judged: JudgedPairs,
    /// For each pair whether no motion at all changes its distance; empty before the first instant.
    is_built: Vec<bool>,
    /// For each pair whether both are links; likewise.
    is_of_links: Vec<bool>,
    pub(crate) links: NearestSeries,
    pub(crate) obstacles: NearestSeries,
    pub(crate) zones: NearestSeries,
}

impl NearestOverTime {
    /// For a run of this number of steps, if it is known: the distances that its checks judge.
    pub(crate) fn new(checks: &[Check], step_s: f64, steps: Option<u64>) -> Self {
        Self {
            stride: stride(step_s, steps),
            links_stride: steps_in(LINKS_PERIOD_S, step_s),
            judged: JudgedPairs::new(checks),
            is_built: Vec::new(),
            is_of_links: Vec::new(),
            links: NearestSeries::with_capacity(ROOM),
            obstacles: NearestSeries::with_capacity(ROOM),
            zones: NearestSeries::with_capacity(ROOM),
        }
    }

    /// Measures at this instant, if the stride has come to it.
    pub(crate) fn observe(&mut self, sample: &mut Sample<'_>, description: &RobotDescription) {
        if !sample.step.is_multiple_of(self.stride) && !sample.is_last {
            self.observe_between(sample);
            return;
        }
        // It also decides which pairs are judged.
        self.judged.nearest(sample.clearance);
        if self.is_built.len() != sample.clearance.pairs().len() {
            self.is_built = sample.clearance.constant_pairs(description);
            let links = sample.twin.len();
            self.is_of_links = sample.clearance.pairs().map(|pair| pair.b < links).collect();
        }
        let (links, judged) = (sample.twin.len(), &self.judged);
        let between_links = |index: usize, pair: Pair| pair.b < links && judged.contains(index);
        self.links.measure(sample.time_s, sample.clearance, between_links);
        let to_obstacles = |index: usize, pair: Pair| pair.b >= links && judged.contains(index);
        self.obstacles.measure(sample.time_s, sample.clearance, to_obstacles);
        self.zones.measure(sample.time_s, sample.zones, |_, _| true);
    }

    /// Keeps what has come nearer since the last measurement.
    fn observe_between(&mut self, sample: &mut Sample<'_>) {
        // No motion changes the distance of a pair that is built so: it would be examined in vain at every step.
        let is_chosen = |pair: usize, is_of_links: bool| {
            self.judged.contains(pair) && !self.is_built[pair] && self.is_of_links[pair] == is_of_links
        };
        let (time_s, clearance) = (sample.time_s, &mut *sample.clearance);
        if sample.step.is_multiple_of(self.links_stride) {
            self.links.measure_nearer(time_s, clearance, |pair| is_chosen(pair, true));
        }
        self.obstacles.measure_nearer(time_s, clearance, |pair| is_chosen(pair, false));
        self.zones.measure_nearer(time_s, sample.zones, |_| true);
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

fn stride(step_s: f64, steps: Option<u64>) -> u64 {
    let at_least = steps_in(PERIOD_S, step_s);
    let steps = steps.unwrap_or_default();
    // A multiple of the least stride: at these steps the recording has measured the distances already.
    at_least * steps.div_ceil(MOST.saturating_mul(at_least)).max(1)
}

/// The number of steps in a period, at least one.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a step is positive, and the cast of floats saturates"
)]
fn steps_in(period_s: f64, step_s: f64) -> u64 {
    ((period_s / step_s).round() as u64).max(1)
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
            ..NearestSeries::default()
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
    fn what_comes_near_between_two_measurements_is_a_value_of_its_own() {
        let near = |pair: usize, distance_m: f64| Nearest { distance_m, pair };
        let few = |pairs: [Nearest; 2]| [Some(pairs[0]), Some(pairs[1]), None, None];
        let mut series = NearestSeries {
            times_s: vec![0.0],
            nearest: vec![few([near(7, 0.03), near(2, 0.5)])],
            ..NearestSeries::default()
        };
        let limits = |series: &NearestSeries, of: [usize; 3]| of.map(|pair| series.nearer_m(pair).to_bits());
        assert_eq!(limits(&series, [7, 2, 5]), [0.9 * 0.03, 0.9 * 0.5, 0.9 * 0.5].map(f64::to_bits));
        series.came_nearer(0.25, near(2, 0.01));
        assert_eq!(limits(&series, [2, 7, 5]), [0.9 * 0.01, 0.9 * 0.03, 0.9 * 0.03].map(f64::to_bits));
        series.end_span();
        assert_eq!(series.times_s, [0.0, 0.25]);
        assert_eq!(series.nearest[1], few([near(2, 0.01), near(7, 0.03)]));
        series.end_span();
        assert_eq!(series.times_s.len(), 2);
    }

    #[test]
    fn no_more_than_fifty_looks_a_second_and_four_hundred_in_all() {
        assert_eq!(stride(0.001, Some(4000)), 20);
        assert_eq!(stride(0.001, Some(600_000)), 1500);
        assert_eq!(stride(0.05, Some(10)), 1);
    }
}
