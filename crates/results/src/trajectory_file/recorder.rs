//! Takes the samples of a run and writes those that are due as rows.

use std::path::Path;

use congruent_monitors::{Recorder, RecordingError, Sample};
use congruent_scenario::TrajectoryFormat;
use congruent_twin::Run;

use super::{
    columns::{SampleCells, header},
    csv::CsvTable,
    parquet::ParquetTable,
    table::TableWriter,
};
use crate::{
    execute::{IfIncomplete, Recording, RecordingFormat},
    report::RunReport,
};

/// Writes a trajectory while the run goes on.
struct TrajectoryRecorder {
    cells: SampleCells,
    table: Box<dyn TableWriter>,
    /// Steps from row to row.
    stride: u64,
}

impl RecordingFormat for TrajectoryFormat {
    fn file_name(&self) -> &'static str {
        match self {
            Self::Csv => "trajectory.csv",
            Self::Parquet => "trajectory.parquet",
        }
    }

    fn if_incomplete(&self) -> IfIncomplete {
        match self {
            Self::Csv => IfIncomplete::Keep,
            // It has its index at its end.
            Self::Parquet => IfIncomplete::Remove,
        }
    }

    fn begin(&self, path: &Path, run: &Run<'_>) -> Result<Box<dyn Recording>, RecordingError> {
        let setup = run.setup();
        let cells = SampleCells::new(&setup.description, run.names());
        let header = header(&setup.description);
        let table: Box<dyn TableWriter> = match self {
            Self::Csv => Box::new(CsvTable::create(path, &header)?),
            Self::Parquet => Box::new(ParquetTable::create(path, &header)?),
        };
        let step_s = setup.clock.step_s;
        let period_s = setup.scenario.output.trajectory_period_s.unwrap_or(step_s);
        Ok(Box::new(TrajectoryRecorder { cells, table, stride: stride(period_s, step_s) }))
    }
}

impl Recording for TrajectoryRecorder {
    fn finish(self: Box<Self>, _: &RunReport) -> Result<(), RecordingError> {
        self.table.finish()
    }
}

impl Recorder for TrajectoryRecorder {
    fn record(&mut self, sample: &mut Sample<'_>) -> Result<(), RecordingError> {
        if !sample.step.is_multiple_of(self.stride) && !sample.is_last {
            return Ok(());
        }
        self.cells.write(sample, &mut *self.table);
        self.table.end_row()
    }
}

/// Steps from row to row; the setup has checked that it is a whole number.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the cast of floats saturates")]
fn stride(period_s: f64, step_s: f64) -> u64 {
    ((period_s / step_s).round() as u64).max(1)
}
