//! Takes the samples of a run for its page, and writes the page with the report.

use std::{
    fs,
    path::{Path, PathBuf},
};

use congruent_monitors::{Recorder, RecordingError, RunClock, Sample, agreement_tolerance};
use congruent_results::{IfIncomplete, Recording, RecordingFormat, report::RunReport};
use congruent_twin::Run;

use super::{content::RunContent, events::Events, page};
use crate::series::{NearestOverTime, RunSeries};

/// The page of a run, `report.html`.
#[derive(Debug, Clone, Copy, Default)]
pub struct PageFormat;

impl RecordingFormat for PageFormat {
    fn file_name(&self) -> &'static str {
        "report.html"
    }

    fn if_incomplete(&self) -> IfIncomplete {
        IfIncomplete::Remove
    }

    fn begin(&self, path: &Path, run: &Run<'_>) -> Result<Box<dyn Recording>, RecordingError> {
        let setup = run.setup();
        let RunClock { step_s, steps, .. } = setup.clock;
        Ok(Box::new(PageRecorder {
            path: path.to_owned(),
            run: RunContent {
                names: run.names().clone(),
                description: setup.description.clone(),
                obstacles: setup.obstacles.clone(),
                obstacles_move: !setup.bodies.is_empty(),
                events: Events::new(&setup.scenario),
                zones: setup.zones.iter().map(|zone| zone.space.clone()).collect(),
                series: RunSeries::new(
                    &setup.description,
                    agreement_tolerance(&setup.scenario.check, setup.description.tolerance),
                    NearestOverTime::new(&setup.scenario.check, step_s, steps),
                ),
            },
        }))
    }
}

#[derive(Debug)]
struct PageRecorder {
    path: PathBuf,
    run: RunContent,
}

impl Recorder for PageRecorder {
    fn record(&mut self, sample: &mut Sample<'_>) -> Result<(), RecordingError> {
        self.run.series.push(sample, &self.run.description);
        Ok(())
    }
}

impl Recording for PageRecorder {
    fn finish(mut self: Box<Self>, report: &RunReport) -> Result<(), RecordingError> {
        self.run.series.finish();
        let folder = self.path.parent().unwrap_or(Path::new("."));
        let html = page::run_page(report, &self.run, folder);
        fs::write(&self.path, html).map_err(|error| RecordingError {
            message: format!("cannot write {}: {error}", self.path.display()),
        })
    }
}
