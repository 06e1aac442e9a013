//! The joint states of a log, row by row, with their efforts as they were recorded.

use congruent_dynamics::BodyTree;
use congruent_identification::{
    Collector, Instants, RecordedEquations, RecordedRow, RecordingSurvey, SampledParts, Smoothing,
};
use congruent_input::{Diagnostic, Findings};
use congruent_scenario::Scenario;
use congruent_twin::{
    RunSetup,
    setup::RecordedSetup,
    source::{Advance, JointStateSource, RecordedSource, SourceError},
};

use crate::codes;

/// A log that is read for its efforts.
pub(super) struct RecordedEfforts {
    setup: RunSetup,
    recorded: RecordedSetup,
    from_s: f64,
    duration_s: f64,
    /// Whether any row has an effort.
    pub(super) has_efforts: bool,
}

/// What is read from a log.
enum RowOrBreak<'a> {
    Row(RecordedRow<'a>),
    /// What follows is not connected with what was before.
    Break,
}

impl RecordedEfforts {
    /// # Errors
    /// The log cannot be read, or does not have the joints.
    pub(super) fn open(
        scenario: Scenario,
        description: &congruent_description::RobotDescription,
    ) -> Result<Self, Findings> {
        let setup = RunSetup::new(scenario, description.clone())?;
        let recorded = setup.recorded.clone().ok_or_else(|| unreadable("the log has no joint states"))?;
        let mut efforts = Self { setup, recorded, from_s: 0.0, duration_s: 0.0, has_efforts: false };
        let (mut times, mut has_efforts): (Option<[f64; 2]>, bool) = (None, false);
        efforts.read(|event| {
            if let RowOrBreak::Row(row) = event {
                times.get_or_insert([row.time_s; 2])[1] = row.time_s;
                has_efforts |= row.effort.iter().any(|effort| effort.is_finite());
            }
            Ok(())
        })?;
        let [from_s, to_s] = times.unwrap_or_default();
        (efforts.from_s, efforts.duration_s, efforts.has_efforts) = (from_s, to_s - from_s, has_efforts);
        Ok(efforts)
    }

    /// Joints that the log does not have.
    pub(super) fn held(&self) -> &[String] {
        &self.recorded.held
    }

    /// How fast the joints move, and how long the window is; `None` if rows are too far apart.
    pub(super) fn survey(&self, half_window_s: Option<f64>) -> Result<Option<RecordingSurvey>, Findings> {
        let mut parts = SampledParts::new(self.from_s, self.duration_s);
        self.read(|event| {
            match event {
                RowOrBreak::Row(row) => parts.push(row),
                RowOrBreak::Break => parts.break_here(),
            }
            Ok(())
        })?;
        Ok(match half_window_s {
            Some(half_window_s) => parts.survey_with(Smoothing { half_window_s }),
            None => parts.survey(),
        })
    }

    /// The equations of the whole log.
    pub(super) fn equations(
        &self,
        tree: &BodyTree,
        survey: &RecordingSurvey,
        instants: Instants,
    ) -> Result<RecordedEquations, Findings> {
        let mut collector = Collector::new(tree, survey.smoothing, instants, self.from_s, self.duration_s);
        self.read(|event| match event {
            RowOrBreak::Row(row) => collector.push(row).map_err(|error| unreadable(&error.to_string())),
            RowOrBreak::Break => {
                collector.break_here();
                Ok(())
            }
        })?;
        Ok(collector.finish())
    }

    /// Gives each row of the log to `each`, from the first on.
    fn read(&self, mut each: impl FnMut(RowOrBreak<'_>) -> Result<(), Findings>) -> Result<(), Findings> {
        let refused = |error: SourceError| unreadable(&error.to_string());
        let robot = &self.setup.description.robot;
        let mut source = RecordedSource::new(&self.recorded, robot, &self.setup.start).map_err(refused)?;
        let mut time_s = source.start_s();
        let unknown = vec![f64::NAN; robot.dof()];
        loop {
            if source.begins_part() {
                each(RowOrBreak::Break)?;
            }
            let joints = source.joints();
            let effort =
                if joints.recorded_effort.is_empty() { &unknown[..] } else { joints.recorded_effort };
            each(RowOrBreak::Row(RecordedRow { time_s, q: joints.measured.q, effort }))?;
            loop {
                match source.advance(0.0).map_err(refused)? {
                    Advance::At(next_s) => {
                        time_s = next_s;
                        break;
                    }
                    Advance::Gap { .. } => each(RowOrBreak::Break)?,
                    Advance::End => return Ok(()),
                }
            }
        }
    }
}

fn unreadable(why: &str) -> Findings {
    Diagnostic::error(codes::replay::READ, why.to_owned()).into()
}
