//! One distance over time.

use congruent_monitors::RecordingError;
use re_log_types::EntityPath;
use re_sdk_types::archetypes::SeriesLines;

use super::scalars::write_scalars;
use crate::rrd::{
    times::{SampleTime, SampleTimes},
    writer::RrdWriter,
};

/// The values of one line.
#[derive(Debug, Default)]
pub(super) struct DistanceLine {
    times: SampleTimes,
    values: Vec<f64>,
    /// Number of earlier lines, which gives the colour.
    pub(super) number: usize,
    has_style: bool,
    /// Smallest and largest value so far.
    range_m: Option<(f64, f64)>,
}

/// A distance that varies by no more is constant in a run, as in the page. Kind: choice. Unit: m.
const CONSTANT_M: f64 = 1e-4;

impl DistanceLine {
    /// A line without values, whose number among the lines gives its colour.
    pub(super) fn numbered(number: usize) -> Self {
        Self { number, ..Self::default() }
    }

    /// Adds the distance at a recorded time. Unit: m.
    pub(super) fn push(&mut self, time: SampleTime, value: f64) {
        self.times.push(time);
        self.values.push(value);
        let (low, high) = self.range_m.unwrap_or((f64::INFINITY, f64::NEG_INFINITY));
        self.range_m = Some((low.min(value), high.max(value)));
    }

    /// Whether all values so far are the same.
    pub(super) fn is_constant(&self) -> bool {
        self.range_m.is_some_and(|(low, high)| high - low <= CONSTANT_M)
    }

    /// Writes the values and removes them; the first time also the style of the line.
    pub(super) fn write(
        &mut self,
        writer: &mut RrdWriter,
        path: &EntityPath,
        style: &SeriesLines,
    ) -> Result<(), RecordingError> {
        if self.times.is_empty() {
            return Ok(());
        }
        if !self.has_style {
            writer.log_static(path, style)?;
            self.has_style = true;
        }
        write_scalars(writer, path, &self.times.columns(), self.values.iter().copied())?;
        self.times.clear();
        self.values.clear();
        Ok(())
    }
}
