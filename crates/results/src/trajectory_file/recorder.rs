//! Takes the samples of a run and writes those that are due as rows.

use std::path::Path;

use congruent_monitors::{Recorder, RecordingError, Sample};
use congruent_scenario::TrajectoryFormat;
use congruent_tables::writer::{CsvTable, ParquetTable, TableWriter};
use congruent_twin::Run;

use super::{
    columns::{SampleCells, header},
    failed::failed,
    run_log::RunLog,
    stride::Stride,
};
use crate::{
    execute::{IfIncomplete, Recording, RecordingFormat},
    report::RunReport,
};

/// Writes a trajectory while the run goes on.
struct TrajectoryRecorder {
    cells: SampleCells,
    table: Box<dyn TableWriter>,
    stride: Stride,
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
        let stride = Stride::of(setup);
        let header = header(&setup.description);
        let table: Box<dyn TableWriter> = match self {
            Self::Csv => Box::new(CsvTable::create(path, &header).map_err(failed)?),
            Self::Parquet => Box::new(ParquetTable::create(path, "trajectory", &header).map_err(failed)?),
            Self::Mcap => return Ok(Box::new(RunLog::create(path, setup, stride)?)),
        };
        let cells = SampleCells::new(&setup.description, run.names());
        Ok(Box::new(TrajectoryRecorder { cells, table, stride }))
    }
}

impl Recording for TrajectoryRecorder {
    fn finish(self: Box<Self>, _: &RunReport) -> Result<(), RecordingError> {
        self.table.finish().map_err(failed)
    }
}

impl Recorder for TrajectoryRecorder {
    fn record(&mut self, sample: &mut Sample<'_>) -> Result<(), RecordingError> {
        if !self.stride.takes(sample) {
            return Ok(());
        }
        self.cells.write(sample, &mut *self.table);
        self.table.end_row().map_err(failed)
    }
}
