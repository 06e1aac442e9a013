//! Clearance over time: the smallest distance, exact at every recorded time, and the distances of pairs that
//! were the nearest or came close to an obstacle.

use std::{collections::BTreeMap, slice::from_ref};

use congruent_monitors::{JudgedPairs, RecordingError};
use congruent_proximity::Clearance;
use congruent_scenario::Check;

use super::{distance_line::DistanceLine, pairs::NEAR_M};
use crate::{
    rrd::{paths, times::SampleTime, writer::RrdWriter},
    scene::{palette, styles::line},
};

/// The most pairs with a line of their own, so that the plot stays readable.
const MAX_PAIRS: usize = 5;

/// Distances of one run until they are written.
#[derive(Debug)]
pub(crate) struct ClearanceSeries {
    judged: JudgedPairs,
    /// The pairs of each check by itself, if there are several: the nearest of each has a line from the start.
    of_checks: Vec<JudgedPairs>,
    minimum: DistanceLine,
    /// Lines of pairs by the pair's index, each from the first time at which the pair was the nearest.
    pairs: BTreeMap<usize, DistanceLine>,
    /// Range of the smallest distance over the run; `None` without pairs.
    pub(crate) range_m: Option<(f64, f64)>,
}

impl ClearanceSeries {
    /// Distances of the pairs that the checks judge.
    pub(crate) fn new(checks: &[Check]) -> Self {
        let judged = JudgedPairs::new(checks);
        let clearances = || checks.iter().filter(|check| matches!(check, Check::Clearance(_)));
        let of_checks = match clearances().count() {
            0 | 1 => Vec::new(),
            _ => clearances().map(|check| JudgedPairs::new(from_ref(check))).collect(),
        };
        Self { judged, of_checks, minimum: DistanceLine::default(), pairs: BTreeMap::new(), range_m: None }
    }

    /// Adds a row, or nothing if there are no pairs. Bodies of a pair with an index below `links` are links.
    pub(crate) fn push(&mut self, time: SampleTime, clearance: &mut Clearance, links: usize) {
        let Some(nearest) = self.judged.nearest(clearance) else { return };
        self.minimum.push(time, nearest.distance_m);
        self.follow(nearest.pair);
        for at in 0..self.of_checks.len() {
            if let Some(nearest) = self.of_checks[at].nearest(clearance) {
                self.follow(nearest.pair);
            }
        }
        // Two links that are always close to each other must not hide an obstacle that the arm approaches.
        let judged = &self.judged;
        let closest = clearance.nearest_of(NEAR_M, |index, pair| pair.b >= links && judged.contains(index));
        if let Some(closest) = closest {
            self.follow(closest.pair);
        }
        for (&pair, line) in &mut self.pairs {
            line.push(time, clearance.measure(pair));
        }
        let (low, high) = self.range_m.unwrap_or((f64::INFINITY, f64::NEG_INFINITY));
        self.range_m = Some((low.min(nearest.distance_m), high.max(nearest.distance_m)));
    }

    /// Gives a pair a line of its own from this time on.
    fn follow(&mut self, pair: usize) {
        let number = self.pairs.len();
        // The first that come near keep their lines: replacing them would break curves in the middle of the plot.
        if number < MAX_PAIRS {
            self.pairs.entry(pair).or_insert_with(|| DistanceLine::numbered(number));
        }
    }

    /// Names of all curves, with that of the limit.
    pub(crate) fn curves(&self, pairs: &[String]) -> Vec<String> {
        let of_all = ["limit", "minimum"].map(str::to_owned).into_iter();
        of_all.chain(self.pairs.keys().map(|&pair| pairs[pair].clone())).collect()
    }

    /// Writes all rows and removes them.
    pub(crate) fn write(&mut self, writer: &mut RrdWriter, pairs: &[String]) -> Result<(), RecordingError> {
        let style = line("minimum", palette::NEUTRAL, 2.5);
        self.minimum.write(writer, &paths::clearance("minimum"), &style)?;
        for (&pair, values) in &mut self.pairs {
            let (name, color) = (pairs[pair].as_str(), palette::link(values.number));
            values.write(writer, &paths::clearance(name), &line(name, color, 1.2))?;
        }
        Ok(())
    }
}
