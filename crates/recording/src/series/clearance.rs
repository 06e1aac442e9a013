//! Clearance over time: the smallest distance, exact at every recorded time, and the distances of pairs that
//! were the nearest or came close to an obstacle.

use std::{collections::BTreeMap, slice::from_ref};

use congruent_description::RobotDescription;
use congruent_monitors::{JudgedPairs, RecordingError};
use congruent_proximity::{Clearance, Pair};
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
    /// For each pair whether no motion changes its distance; empty before the first row.
    is_built: Vec<bool>,
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
        Self {
            judged,
            of_checks,
            minimum: DistanceLine::default(),
            pairs: BTreeMap::new(),
            is_built: Vec::new(),
            range_m: None,
        }
    }

    /// Adds a row, or nothing if there are no pairs. Bodies of a pair with an index below the number of links are links.
    pub(crate) fn push(&mut self, time: SampleTime, clearance: &mut Clearance, of: &RobotDescription) {
        let Some(nearest) = self.judged.nearest(clearance) else { return };
        let links = of.robot.links().len();
        if self.is_built.len() != clearance.pairs().len() {
            self.is_built = clearance.constant_pairs(of);
        }
        self.minimum.push(time, nearest.distance_m);
        self.follow(nearest.pair);
        for at in 0..self.of_checks.len() {
            if let Some(nearest) = self.of_checks[at].nearest(clearance) {
                self.follow(nearest.pair);
            }
        }
        // Two links that are always close to each other must not hide an obstacle that the arm approaches.
        let (judged, is_built) = (&self.judged, &self.is_built);
        let can_approach =
            |index: usize, pair: Pair| pair.b >= links && judged.contains(index) && !is_built[index];
        let closest = clearance.nearest_of(NEAR_M, can_approach);
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
        of_all.chain(self.pairs.iter().map(|(&pair, values)| self.name(pair, values, pairs))).collect()
    }

    /// The name of a pair, with whether its distance never changes.
    fn name(&self, pair: usize, values: &DistanceLine, pairs: &[String]) -> String {
        match (values.is_constant(), self.is_built[pair]) {
            (true, true) => format!("{} (constant: built that way)", pairs[pair]),
            (true, false) => format!("{} (constant in this run)", pairs[pair]),
            (false, _) => pairs[pair].clone(),
        }
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

    /// After the last row: says of pairs that kept their distance that they did, so that nobody takes them for what came near.
    pub(crate) fn name_constant(
        &self,
        writer: &mut RrdWriter,
        pairs: &[String],
    ) -> Result<(), RecordingError> {
        for (&pair, values) in self.pairs.iter().filter(|(_, values)| values.is_constant()) {
            let name = self.name(pair, values, pairs);
            let style = line(&name, palette::link(values.number), 0.8);
            writer.log_static(&paths::clearance(&pairs[pair]), &style)?;
        }
        Ok(())
    }
}
