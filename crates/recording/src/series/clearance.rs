//! Clearance over time: the smallest distance, exact at every recorded time, and the distances of pairs that
//! were the nearest or came close to an obstacle.

use std::collections::BTreeMap;

use congruent_twin::{proximity::Clearance, recorder::RecordingError};
use re_sdk_types::{archetypes::SeriesLines, components::Color};

use super::scalars::write_scalars;
use crate::{
    rrd::{
        paths,
        times::{SampleTime, SampleTimes},
        writer::RrdWriter,
    },
    scene::palette,
};

/// The most pairs with a line of their own, so that the plot stays readable.
const MAX_PAIRS: usize = 8;

/// Below this distance, a pair of a link and an obstacle gets a line.
const NEAR_M: f64 = 0.1;

/// The values of one line.
#[derive(Debug, Default)]
struct DistanceLine {
    times: SampleTimes,
    values: Vec<f64>,
    /// Number of earlier lines, which gives the colour.
    number: usize,
    has_style: bool,
}

impl DistanceLine {
    fn numbered(number: usize) -> Self {
        Self { number, ..Self::default() }
    }

    fn push(&mut self, time: SampleTime, value: f64) {
        self.times.push(time);
        self.values.push(value);
    }

    /// Writes the values; the first time also colour and width of the line.
    fn write(
        &mut self,
        writer: &mut RrdWriter,
        name: &str,
        (color, width): (Color, f32),
    ) -> Result<(), RecordingError> {
        let path = paths::clearance(name);
        if !self.has_style {
            let style = SeriesLines::new().with_names([name]).with_colors([color]).with_widths([width]);
            writer.log_static(&path, &style)?;
            self.has_style = true;
        }
        if !self.times.is_empty() {
            write_scalars(writer, &path, &self.times.columns(), self.values.iter().copied())?;
        }
        self.times.clear();
        self.values.clear();
        Ok(())
    }
}

/// Distances of one run until they are written.
#[derive(Debug, Default)]
pub(crate) struct ClearanceSeries {
    minimum: DistanceLine,
    /// Lines of pairs by the pair's index, each from the first time at which the pair was the nearest.
    pairs: BTreeMap<usize, DistanceLine>,
    /// Range of the smallest distance over the run; `None` without pairs.
    pub(crate) range_m: Option<(f64, f64)>,
}

impl ClearanceSeries {
    /// Adds a row, or nothing if there are no pairs. Bodies of a pair with an index below `links` are links.
    pub(crate) fn push(&mut self, time: SampleTime, clearance: &mut Clearance, links: usize) {
        let Some(nearest) = clearance.nearest() else { return };
        self.minimum.push(time, nearest.distance_m);
        self.follow(nearest.pair);
        // Two links that are always close to each other must not hide an obstacle that the arm approaches.
        if let Some(closest) = clearance.nearest_of(NEAR_M, |_, pair| pair.b >= links) {
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
        if number < MAX_PAIRS {
            self.pairs.entry(pair).or_insert_with(|| DistanceLine::numbered(number));
        }
    }

    /// Writes all rows and removes them.
    pub(crate) fn write(&mut self, writer: &mut RrdWriter, pairs: &[String]) -> Result<(), RecordingError> {
        if self.minimum.times.is_empty() {
            return Ok(());
        }
        self.minimum.write(writer, "minimum", (palette::NEUTRAL, 2.5))?;
        for (&pair, line) in &mut self.pairs {
            line.write(writer, &pairs[pair], (palette::link(line.number), 1.2))?;
        }
        Ok(())
    }
}
