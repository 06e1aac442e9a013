//! Clearance over time: the smallest distance, exact at every recorded instant, and the pairs that
//! have been the smallest or came close to an obstacle.

use std::collections::BTreeMap;

use congruent_twin::{proximity::Clearance, recorder::RecordingError};
use re_sdk_types::{archetypes::SeriesLines, components::Color};

use crate::{
    batch::write_scalars,
    palette, paths,
    times::{Instant, Times},
    writer::RrdWriter,
};

/// Pairs that get a line of their own: as many as a plot stays readable with.
const MOST_PAIRS: usize = 8;

/// From where on an obstacle is close enough to be followed.
const NEAR_M: f64 = 0.1;

/// Values of one line.
#[derive(Debug, Default)]
struct Line {
    times: Times,
    values: Vec<f64>,
    /// How many lines were there before: gives the colour.
    number: usize,
    is_styled: bool,
}

impl Line {
    fn numbered(number: usize) -> Self {
        Self { number, ..Self::default() }
    }

    fn push(&mut self, instant: Instant, value: f64) {
        self.times.push(instant);
        self.values.push(value);
    }

    /// Writes the values, and before the first of them colour and width of the line.
    fn write(
        &mut self,
        writer: &mut RrdWriter,
        name: &str,
        (color, width): (Color, f32),
    ) -> Result<(), RecordingError> {
        let path = paths::clearance(name);
        if !self.is_styled {
            let style = SeriesLines::new().with_names([name]).with_colors([color]).with_widths([width]);
            writer.log_static(&path, &style)?;
            self.is_styled = true;
        }
        if !self.times.is_empty() {
            write_scalars(writer, &path, &self.times.columns(), self.values.iter().copied())?;
        }
        self.times.clear();
        self.values.clear();
        Ok(())
    }
}

/// Gathers distances until they are written.
#[derive(Debug, Default)]
pub(super) struct Distances {
    minimum: Line,
    /// By the pair's number: each from the instant on when it was the nearest first.
    pairs: BTreeMap<usize, Line>,
    /// The smallest and the largest of the smallest distances.
    pub(super) range_m: Option<(f64, f64)>,
}

impl Distances {
    /// Adds a row; without pairs there is none. Subjects below `links` are links.
    pub(super) fn push(&mut self, instant: Instant, clearance: &mut Clearance, links: usize) {
        let Some(nearest) = clearance.nearest() else { return };
        self.minimum.push(instant, nearest.distance_m);
        self.follow(nearest.pair);
        // Two links that are always close to each other must not hide what the arm comes close to.
        clearance.nearest_below(NEAR_M);
        let to_obstacles = clearance.pairs().enumerate().filter(|(_, pair)| pair.b >= links);
        let measured = to_obstacles.filter_map(|(pair, _)| Some((pair, clearance.current_m(pair)?)));
        let closest =
            measured.filter(|&(_, distance_m)| distance_m < NEAR_M).min_by(|(_, a), (_, b)| a.total_cmp(b));
        if let Some((pair, _)) = closest {
            self.follow(pair);
        }
        for (&pair, line) in &mut self.pairs {
            line.push(instant, clearance.measure(pair));
        }
        let (low, high) = self.range_m.unwrap_or((f64::INFINITY, f64::NEG_INFINITY));
        self.range_m = Some((low.min(nearest.distance_m), high.max(nearest.distance_m)));
    }

    /// Gives a pair a line of its own from now on.
    fn follow(&mut self, pair: usize) {
        let number = self.pairs.len();
        if number < MOST_PAIRS {
            self.pairs.entry(pair).or_insert_with(|| Line::numbered(number));
        }
    }

    /// Writes all rows and forgets them.
    pub(super) fn write(&mut self, writer: &mut RrdWriter, pairs: &[String]) -> Result<(), RecordingError> {
        if self.minimum.times.is_empty() {
            return Ok(());
        }
        self.minimum.write(writer, "minimum", (palette::MINIMUM, 2.5))?;
        for (&pair, line) in &mut self.pairs {
            line.write(writer, &pairs[pair], (palette::link(line.number), 1.2))?;
        }
        Ok(())
    }
}
