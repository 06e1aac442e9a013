//! Distances of zones over time: of each the distance of the nearest link that is forbidden to enter it.

use congruent_monitors::RecordingError;
use congruent_proximity::Clearance;

use super::distance_line::DistanceLine;
use crate::{
    rrd::{paths, times::SampleTime, writer::RrdWriter},
    scene::{palette, styles::line},
};

/// Width of a line on the screen.
const WIDTH_UI_POINTS: f32 = 2.0;

/// Distances of all zones until they are written.
#[derive(Debug)]
pub(crate) struct ZoneSeries {
    /// In the order of the scenario.
    lines: Vec<DistanceLine>,
    /// Range of all distances; `None` without zones.
    pub(crate) range_m: Option<(f64, f64)>,
}

impl ZoneSeries {
    /// A series without rows, for this number of zones.
    pub(crate) fn new(zones: usize) -> Self {
        Self { lines: (0..zones).map(DistanceLine::numbered).collect(), range_m: None }
    }

    /// Adds a row with the distance of the nearest forbidden link for each zone.
    pub(crate) fn push(&mut self, time: SampleTime, zones: &mut Clearance, links: usize) {
        for (zone, line) in self.lines.iter_mut().enumerate() {
            let nearest = zones.nearest_of(f64::INFINITY, |_, pair| pair.a == links + zone);
            if let Some(nearest) = nearest {
                line.push(time, nearest.distance_m);
                let (low, high) = self.range_m.unwrap_or((f64::INFINITY, f64::NEG_INFINITY));
                self.range_m = Some((low.min(nearest.distance_m), high.max(nearest.distance_m)));
            }
        }
    }

    /// Writes all rows and removes them; `names` are those of the zones.
    pub(crate) fn write(
        &mut self,
        writer: &mut RrdWriter,
        names: impl Iterator<Item = impl AsRef<str>>,
    ) -> Result<(), RecordingError> {
        for (values, name) in self.lines.iter_mut().zip(names) {
            let (name, color) = (name.as_ref(), palette::link(values.number));
            values.write(writer, &paths::zone_distance(name), &line(name, color, WIDTH_UI_POINTS))?;
        }
        Ok(())
    }
}
