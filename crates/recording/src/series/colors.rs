//! Links, obstacles and zones that violate a limit are drawn in a colour that nothing else has, as long as they do.

use congruent_monitors::RecordingError;
use re_log_types::EntityPath;
use re_sdk_types::{SerializedComponentBatch, SerializedComponentColumn};

use crate::{
    rrd::{
        times::{SampleTime, SampleTimes},
        writer::{RrdWriter, failed},
    },
    scene::{shapes::SceneBody, visual::Coloring},
};

/// A body that began or ceased to violate a limit.
#[derive(Debug, Clone, Copy)]
struct ColorChange {
    body: usize,
    time: SampleTime,
    is_violating: bool,
}

/// The colours of all bodies until they are written.
#[derive(Debug)]
pub(crate) struct ColorSeries {
    /// For each body, whether it is drawn as violating; `None` before the first sample.
    shown: Vec<Option<bool>>,
    changes: Vec<ColorChange>,
}

impl ColorSeries {
    /// Colours without rows, for this number of bodies.
    pub(crate) fn new(bodies: usize) -> Self {
        Self { shown: vec![None; bodies], changes: Vec::with_capacity(2 * bodies) }
    }

    /// Adds a row for each body that changes.
    pub(crate) fn push(&mut self, time: SampleTime, are_violating: &[bool]) {
        for (body, (shown, &is_violating)) in self.shown.iter_mut().zip(are_violating).enumerate() {
            // Changes only: the viewer keeps the latest colour, and a row for each sample would be most of the
            // file.
            if *shown != Some(is_violating) {
                *shown = Some(is_violating);
                self.changes.push(ColorChange { body, time, is_violating });
            }
        }
    }

    /// Whether any body is drawn as violating at the last time.
    pub(crate) fn is_any_violating(&self) -> bool {
        self.shown.contains(&Some(true))
    }

    /// Writes all rows and removes them.
    pub(crate) fn write(
        &mut self,
        writer: &mut RrdWriter,
        bodies: &[SceneBody],
    ) -> Result<(), RecordingError> {
        for (index, body) in bodies.iter().enumerate() {
            self.write_body(writer, index, body)?;
        }
        self.changes.clear();
        Ok(())
    }

    fn write_body(
        &self,
        writer: &mut RrdWriter,
        index: usize,
        body: &SceneBody,
    ) -> Result<(), RecordingError> {
        let mut times = SampleTimes::default();
        // The rows of each path.
        let mut columns: Vec<(EntityPath, Vec<Vec<SerializedComponentBatch>>)> = Vec::new();
        for change in self.changes.iter().filter(|change| change.body == index) {
            times.push(change.time);
            let coloring =
                if change.is_violating { Coloring::Uniform(body.violating) } else { Coloring::AsDescribed };
            for (index, (path, parts)) in body.visual.colors(&body.path, coloring).into_iter().enumerate() {
                if columns.len() <= index {
                    columns.push((path, Vec::new()));
                }
                columns[index].1.push(parts);
            }
        }
        let times = times.columns();
        for (path, rows) in columns {
            writer.columns(&path, &times, stack(&rows)?)?;
        }
        Ok(())
    }
}

/// Columns of rows that all have the same components.
fn stack(rows: &[Vec<SerializedComponentBatch>]) -> Result<Vec<SerializedComponentColumn>, RecordingError> {
    use re_chunk::external::arrow::{array::Array, compute::concat};
    let components = rows.first().map_or(0, Vec::len);
    let column = |index: usize| {
        let pieces: Vec<&dyn Array> = rows.iter().map(|row| row[index].array.as_ref()).collect();
        let whole = SerializedComponentBatch {
            array: concat(&pieces).map_err(failed)?,
            descriptor: rows[0][index].descriptor.clone(),
        };
        whole.partitioned(pieces.iter().map(|piece| piece.len())).map_err(failed)
    };
    (0..components).map(column).collect()
}
