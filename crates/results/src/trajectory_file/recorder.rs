//! Takes the samples of a run and writes those that are due as rows.

use std::path::Path;

use congruent_monitors::{Recorder, RecordingError, Sample};
use congruent_scenario::TrajectoryFormat;
use congruent_twin::Run;

use super::{
    columns::{SampleCells, header},
    csv::CsvTable,
    parquet::ParquetTable,
    run_log::RunLog,
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
            Self::Mcap => "trajectory.mcap",
        }
    }

    fn if_incomplete(&self) -> IfIncomplete {
        match self {
            Self::Csv | Self::Mcap => IfIncomplete::Keep,
            // It has its index at its end.
            Self::Parquet => IfIncomplete::Remove,
        }
    }

    fn begin(&self, path: &Path, run: &Run<'_>) -> Result<Box<dyn Recording>, RecordingError> {
        let setup = run.setup();
        let step_s = setup.clock.step_s;
        let stride = stride(setup.scenario.output.trajectory_period_s.unwrap_or(step_s), step_s);
        let header = header(&setup.description);
        let table: Box<dyn TableWriter> = match self {
            Self::Csv => Box::new(CsvTable::create(path, &header)?),
            Self::Parquet => Box::new(ParquetTable::create(path, &header)?),
            Self::Mcap => return Ok(Box::new(RunLog::create(path, setup, stride)?)),
        };
        let cells = SampleCells::new(&setup.description, run.names());
        Ok(Box::new(TrajectoryRecorder { cells, table, stride }))
    }
}

impl Recording for TrajectoryRecorder {
    fn finish(self: Box<Self>, _: &RunReport) -> Result<(), RecordingError> {
        self.table.finish()
    }
}

impl Recorder for TrajectoryRecorder {
    fn record(&mut self, sample: &mut Sample<'_>) -> Result<(), RecordingError> {
        if !is_due(sample, self.stride) {
            return Ok(());
        }
        self.cells.write(sample, &mut *self.table);
        self.table.end_row()
    }
}

/// Whether a sample is written: each at its turn, and the last.
pub(super) fn is_due(sample: &Sample<'_>, stride: u64) -> bool {
    sample.step.is_multiple_of(stride) || sample.is_last
}

/// Steps from row to row; the setup has checked that it is a whole number.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the cast of floats saturates")]
fn stride(period_s: f64, step_s: f64) -> u64 {
    ((period_s / step_s).round() as u64).max(1)
}
