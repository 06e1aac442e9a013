//! The recorder: takes the samples of a run and writes them in batches, then the results and the layout.

use std::path::Path;

use congruent_agreement::compare::PoseSource;
use congruent_description::{Obstacle, RobotDescription};
use congruent_monitors::{Names, Recorder, RecordingError, Sample, agreement_tolerance, verdict::CheckValue};
use congruent_results::{IfIncomplete, Recording, RecordingFormat, report::RunReport};
use congruent_twin::{Run, RunSetup};
use nalgebra::{Isometry3, Point3};
use re_log_types::{StoreId, StoreKind};

use crate::{
    blueprint::layout::ViewerLayout,
    outcome::{
        joint_limits,
        limit_lines::LimitLines,
        summary,
        timeline::{self, CarriedFor},
    },
    rrd::{
        identity,
        times::{SampleTime, stride},
        writer::RrdWriter,
    },
    scene::{
        camera::{BoundingBox, Camera, ThinnedPath},
        frames,
        shapes::{self, SceneBody},
        styles,
    },
    series::{
        checks::{CheckSeries, violating_link},
        clearance::ClearanceSeries,
        colors::ColorSeries,
        disagreement::DisagreementSeries,
        extents::Extents,
        pairs::PairSeries,
        samples::SampleBatch,
        zones::ZoneSeries,
    },
};

/// Writes a recording for the rerun viewer in batches. [`Recording::finish`] completes the file; without it
/// the recording has neither verdict nor layout, but the samples in it can be read.
pub struct RerunRecorder {
    writer: RrdWriter,
    layout_store: StoreId,
    names: Names,
    description: RobotDescription,
    obstacles: Vec<Obstacle>,
    moving: Vec<String>,
    carried: Vec<CarriedFor>,
    zones: Vec<Obstacle>,
    bodies: Vec<SceneBody>,
    /// The body of each link: the link that a joint moves and that it is fixed to.
    body_of_link: Vec<usize>,
    /// Which of the bodies violate a limit at the present sample.
    are_violating: Vec<bool>,
    tip_from_tcp: Isometry3<f64>,
    stride: u64,
    /// Number of checks that had been violated at the sample before.
    violated_checks: usize,
    batch: SampleBatch,
    disagreement: DisagreementSeries,
    pairs: PairSeries,
    colors: ColorSeries,
    clearance: ClearanceSeries,
    zone_distances: ZoneSeries,
    checks: CheckSeries,
    extents: Extents,
    /// Boxes around the shapes of the links, in their own frames.
    link_boxes: Vec<BoundingBox>,
    robot_box: BoundingBox,
    tool_path: ThinnedPath,
}

impl std::fmt::Debug for RerunRecorder {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("RerunRecorder").finish_non_exhaustive()
    }
}

impl RerunRecorder {
    /// Creates the file and writes the data that do not change: shapes, names, colours.
    ///
    /// `sources` are the model's sources of poses, in the robot's order of links. If a table gives the poses of some
    /// links, the plots leave out the links whose poses come from the URDF alone.
    ///
    /// # Errors
    /// [`RecordingError`] if the file cannot be written.
    pub fn create(
        path: &Path,
        setup: &RunSetup,
        names: &Names,
        sources: &[PoseSource],
    ) -> Result<Self, RecordingError> {
        let description = &setup.description;
        let robot = &description.robot;
        // Without a check of agreement nothing is violated, but the arrows still have to appear at some error.
        let limits = agreement_tolerance(&setup.scenario.check, description.tolerance);
        let mut writer = RrdWriter::create(path, identity::store(setup, StoreKind::Recording))?;
        let bodies = shapes::bodies(setup);
        shapes::write(&mut writer, setup, &bodies)?;
        frames::write(&mut writer, description)?;
        DisagreementSeries::write_static(&mut writer)?;
        PairSeries::write_static(&mut writer)?;
        styles::write(&mut writer, &description.robot, names, sources)?;
        // Shapes and frames are in the file before the first sample: a run that is killed early still shows its
        // robot.
        writer.flush()?;
        Ok(Self {
            writer,
            layout_store: identity::store(setup, StoreKind::Blueprint),
            names: names.clone(),
            description: description.clone(),
            obstacles: setup.obstacles.clone(),
            moving: moving_names(setup),
            carried: CarriedFor::of_scenario(&setup.scenario),
            zones: setup.zones.iter().map(|zone| zone.space.clone()).collect(),
            body_of_link: robot.link_indices().map(|link| robot.body(link).get()).collect(),
            are_violating: vec![false; bodies.len()],
            colors: ColorSeries::new(bodies.len()),
            bodies,
            tip_from_tcp: description.tip_from_tcp.unwrap_or_else(Isometry3::identity),
            stride: stride(setup.clock.step_s),
            violated_checks: 0,
            batch: SampleBatch::new(names, moving_names(setup)),
            disagreement: DisagreementSeries::new(names.links.len(), limits),
            pairs: PairSeries::new(&setup.scenario.check),
            clearance: ClearanceSeries::new(&setup.scenario.check),
            zone_distances: ZoneSeries::new(setup.zones.len()),
            checks: CheckSeries::default(),
            extents: Extents::new(names.joints.len(), names.links.len()),
            link_boxes: robot.links().iter().map(shapes::link_box).collect(),
            robot_box: BoundingBox::empty(),
            tool_path: ThinnedPath::new(),
        })
    }

    /// Marks the links that checks of joints and links have found outside their limits, with what is fixed to them.
    fn mark_links(&mut self, values: &[CheckValue]) {
        let robot = &self.description.robot;
        for link in values.iter().filter_map(|value| violating_link(value, robot)) {
            let body = self.body_of_link[link];
            for (marked, _) in
                self.are_violating.iter_mut().zip(&self.body_of_link).filter(|(_, of)| **of == body)
            {
                *marked = true;
            }
        }
    }

    fn write_batch(&mut self) -> Result<(), RecordingError> {
        self.batch.write(&mut self.writer, &self.names)?;
        self.disagreement.write(&mut self.writer, &self.names.links)?;
        self.pairs.write(&mut self.writer, &self.names)?;
        self.colors.write(&mut self.writer, &self.bodies)?;
        self.clearance.write(&mut self.writer, &self.names.pairs)?;
        self.zone_distances.write(&mut self.writer, self.zones.iter().map(|zone| &zone.name))?;
        self.checks.write(&mut self.writer)?;
        self.writer.flush()
    }
}

impl Recorder for RerunRecorder {
    fn record(&mut self, sample: &mut Sample<'_>) -> Result<(), RecordingError> {
        // Every sample: a worst value between two recorded samples must not be lost.
        self.checks.observe(sample.values);
        let is_violation = sample.violated_checks > self.violated_checks;
        self.violated_checks = sample.violated_checks;
        // The stride keeps the file small; a new violation is recorded at its step, and the last sample always.
        let is_due = is_violation || sample.step.is_multiple_of(self.stride) || sample.is_last;
        if !is_due && !self.disagreement.would_change(sample.errors) {
            return Ok(());
        }
        if self.batch.is_full() {
            self.write_batch()?;
        }
        let time = SampleTime::new(sample.time_s, sample.step);
        let tip = self.description.tip.get();
        let by_twin = sample.twin[tip] * self.tip_from_tcp;
        let by_model = sample.model[tip].to_isometry() * self.tip_from_tcp;
        let tool_in_world = Point3::from(by_twin.translation.vector);
        for ((twin, model), own) in sample.twin.iter().zip(sample.model).zip(&self.link_boxes) {
            self.robot_box.include_box(own, twin);
            // The origins of the model, too: if it disagrees, the camera must have both arms in its picture.
            self.robot_box.include(&Point3::from(model.translation));
        }
        self.robot_box.include(&tool_in_world);
        self.tool_path.push(tool_in_world);
        self.batch.push(time, sample, [&by_twin, &by_model]);
        self.extents.include(sample);
        // Reset for each row: disagreement, pairs and checks mark the bodies again, then the colours take the
        // marks.
        self.are_violating.fill(false);
        self.disagreement.push(time, sample, &mut self.are_violating);
        self.pairs.push(time, sample, &mut self.are_violating);
        self.mark_links(sample.values);
        self.colors.push(time, &self.are_violating);
        self.checks.push(time);
        self.clearance.push(time, sample.clearance, &self.description);
        self.zone_distances.push(time, sample.zones, sample.twin.len());
        Ok(())
    }
}

impl Recording for RerunRecorder {
    fn finish(mut self: Box<Self>, report: &RunReport) -> Result<(), RecordingError> {
        self.write_batch()?;
        self.clearance.name_constant(&mut self.writer, &self.names.pairs)?;
        shapes::write_names(&mut self.writer, &self.obstacles, &self.moving, &self.zones, self.robot_box)?;
        let lines = LimitLines::until(timeline::time(report, report.simulation.duration_s));
        lines.write_checks(&mut self.writer, report)?;
        let robot = &self.description.robot;
        let near_limits = joint_limits::near_limits(robot, &self.extents.joints);
        joint_limits::write(&mut self.writer, &lines, robot, &self.names, &near_limits)?;
        for (number, name) in self.names.joints.iter().enumerate() {
            if self.extents.joints[number].is_misread {
                styles::write_measured(&mut self.writer, robot, number, name)?;
            }
        }
        timeline::write(&mut self.writer, report, &self.carried)?;
        summary::write(&mut self.writer, report)?;
        let layout = ViewerLayout {
            description: &self.description,
            names: &self.names,
            report,
            has_obstacles: !self.obstacles.is_empty(),
            camera: Camera::framing(self.robot_box, &self.obstacles, self.tool_path.points()),
            clearance_m: self.clearance.range_m,
            zones_m: self.zone_distances.range_m,
            distance_curves: &self.clearance.curves(&self.names.pairs),
            extents: &self.extents,
            near_limits: &near_limits,
            recorded: &self.checks.recorded(),
            ends_in_violation: self.colors.is_any_violating() || self.checks.is_any_outside(),
        };
        // Last, since the layout follows from what was recorded; a run that breaks has its samples without a
        // layout.
        self.writer.open_store(self.layout_store)?;
        layout.write(&mut self.writer)?;
        self.writer.activate_blueprint()?;
        self.writer.finish()
    }
}

/// Recordings for the rerun viewer, as a run starts them.
#[derive(Debug, Clone, Copy, Default)]
pub struct RerunFormat;

impl RecordingFormat for RerunFormat {
    fn file_name(&self) -> &'static str {
        "recording.rrd"
    }

    fn if_incomplete(&self) -> IfIncomplete {
        IfIncomplete::Keep
    }

    fn begin(&self, path: &Path, run: &Run<'_>) -> Result<Box<dyn Recording>, RecordingError> {
        let recorder = RerunRecorder::create(path, run.setup(), run.names(), run.model().sources())?;
        Ok(Box::new(recorder))
    }
}

/// Names of the obstacles that move.
fn moving_names(setup: &RunSetup) -> Vec<String> {
    setup.bodies.iter().map(|body| setup.obstacles[body.obstacle].name.clone()).collect()
}
