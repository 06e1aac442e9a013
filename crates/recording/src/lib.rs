//! Recordings that the rerun viewer opens: twin, model and their disagreement over time. The only
//! module that names rerun. What is not here: any figure that a report needs. A recording shows
//! a run, it never decides anything.
//!
//! Equal runs give equal bytes: no wall clock, counted identities, a sorted footer.

mod batch;
mod blueprint;
mod body;
mod camera;
mod disagreement;
mod distances;
mod identity;
mod node;
mod outcome;
mod palette;
mod paths;
mod read;
mod scene;
mod summary;
mod times;
mod units;
mod writer;

use std::path::Path;

use congruent_description::RobotDescription;
use congruent_simulation::Obstacle;
use nalgebra::{Isometry3, Point3};
use re_log_types::{StoreId, StoreKind};

pub use read::{EntitySummary, InspectError, RecordingSummary, ScalarSummary, TimelineSummary, inspect};

use crate::{
    batch::Batch,
    blueprint::Layout,
    body::Body,
    camera::{Bounds, Camera, Thinned},
    disagreement::{AgreementLimits, Disagreement},
    distances::Distances,
    times::Instant,
    writer::RrdWriter,
};
use congruent_agreement::compare::model::PoseSource;
use congruent_twin::{
    Recording, RecordingFormat, Run, Sample,
    monitor::{Check, Names},
    recorder::{Recorder, RecordingError},
    report::RunReport,
    scenario::Scenario,
};

/// Samples are kept at this rate of simulated time, or at every step where steps are longer.
const PERIOD_S: f64 = 0.01;

/// Writes what the viewer shows, in batches. [`Recording::finish`] closes the file; without it
/// the recording has no verdict and no layout, but what was recorded can be read.
pub struct RerunRecorder {
    writer: RrdWriter,
    layout: StoreId,
    names: Names,
    description: RobotDescription,
    obstacles: Vec<Obstacle>,
    bodies: Vec<Body>,
    tip_from_tcp: Isometry3<f64>,
    stride: u64,
    batch: Batch,
    disagreement: Disagreement,
    distances: Distances,
    seen: Bounds,
    tool_way: Thinned,
}

impl std::fmt::Debug for RerunRecorder {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("RerunRecorder").finish_non_exhaustive()
    }
}

impl RerunRecorder {
    /// Makes the file and writes what does not change: names, shapes, colours.
    ///
    /// `sources` are the model's, in the robot's order of links: links that only the URDF places
    /// start hidden in the plots where a table places others.
    ///
    /// # Errors
    /// [`RecordingError`] where the file cannot be written.
    pub fn create(
        path: &Path,
        scenario: &Scenario,
        names: &Names,
        sources: &[PoseSource],
        checks: &[Check],
    ) -> Result<Self, RecordingError> {
        let description = &scenario.description;
        let tolerance = description.tolerance;
        let limits = AgreementLimits::of(checks).unwrap_or(AgreementLimits {
            position_m: tolerance.position_m,
            orientation_rad: tolerance.orientation_rad,
        });
        let mut writer = RrdWriter::create(path, identity::store(scenario, StoreKind::Recording))?;
        let bodies = scene::bodies(&description.robot, 0.0);
        scene::write(&mut writer, scenario, &bodies)?;
        scene::write_styles(&mut writer, &description.robot, names, sources)?;
        writer.flush()?;
        Ok(Self {
            writer,
            layout: identity::store(scenario, StoreKind::Blueprint),
            names: names.clone(),
            description: description.clone(),
            obstacles: scenario.obstacles.clone(),
            bodies,
            tip_from_tcp: description.tip_from_tcp.unwrap_or_else(Isometry3::identity),
            stride: stride(scenario.simulation.step_s),
            batch: Batch::new(names),
            disagreement: Disagreement::new(names.links.len(), limits),
            distances: Distances::default(),
            seen: Bounds::nothing(),
            tool_way: Thinned::default(),
        })
    }

    fn write_batch(&mut self) -> Result<(), RecordingError> {
        self.batch.write(&mut self.writer, &self.names)?;
        self.disagreement.write(&mut self.writer, &self.names.links, &self.bodies)?;
        self.distances.write(&mut self.writer, &self.names.pairs)?;
        self.writer.flush()
    }
}

impl Recording for RerunRecorder {
    fn finish(mut self: Box<Self>, report: &RunReport) -> Result<(), RecordingError> {
        self.write_batch()?;
        outcome::write(&mut self.writer, report)?;
        summary::write(&mut self.writer, report)?;
        let layout = Layout {
            description: &self.description,
            names: &self.names,
            report,
            has_obstacles: !self.obstacles.is_empty(),
            camera: Camera::framing(self.seen, &self.obstacles, self.tool_way.points()),
            clearance_m: self.distances.range_m,
        };
        self.writer.open_store(self.layout)?;
        layout.write(&mut self.writer)?;
        self.writer.activate_blueprint()?;
        self.writer.finish()
    }
}

/// Recordings for the rerun viewer.
#[derive(Debug, Clone, Copy, Default)]
pub struct RerunFormat;

impl RecordingFormat for RerunFormat {
    fn begin(
        &self,
        path: &Path,
        run: &Run<'_>,
        checks: &[Check],
    ) -> Result<Box<dyn Recording>, RecordingError> {
        let recorder =
            RerunRecorder::create(path, run.scenario(), run.names(), run.model().sources(), checks)?;
        Ok(Box::new(recorder))
    }
}

impl Recorder for RerunRecorder {
    fn record(&mut self, sample: &mut Sample<'_>) -> Result<(), RecordingError> {
        let is_due = sample.step.is_multiple_of(self.stride) || sample.is_last;
        if !is_due && !self.disagreement.would_change(sample.errors) {
            return Ok(());
        }
        if self.batch.is_full() {
            self.write_batch()?;
        }
        let instant = Instant::new(sample.time_s, sample.step);
        let world_from_tip = &sample.twin[self.description.tip.get()];
        let tool_in_world = world_from_tip * self.tip_from_tcp * Point3::origin();
        for (twin, model) in sample.twin.iter().zip(sample.model) {
            self.seen.include(&Point3::from(twin.translation.vector));
            self.seen.include(&Point3::from(model.translation));
        }
        self.seen.include(&tool_in_world);
        self.tool_way.push(tool_in_world);
        self.batch.push(instant, sample, &tool_in_world);
        self.disagreement.push(instant, sample);
        self.distances.push(instant, sample.clearance, sample.twin.len());
        Ok(())
    }
}

/// Steps between two samples that are kept.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a step is positive, and the cast of floats saturates"
)]
fn stride(step_s: f64) -> u64 {
    ((PERIOD_S / step_s).round() as u64).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hundred_samples_a_second_at_most() {
        assert_eq!([0.001, 0.002, 0.01, 0.0004, 0.005].map(stride), [10, 5, 1, 25, 2]);
        assert_eq!(stride(1e-9), 10_000_000);
    }
}
