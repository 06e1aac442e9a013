//! Poses, errors, joint positions and the tool's path, gathered in columns and written in batches.

use congruent_kinematics::{Pose, PoseError, larger};
use congruent_monitors::{Names, RecordingError, Sample};
use nalgebra::Isometry3;
use re_chunk::TimeColumn;
use re_sdk_types::{
    archetypes::{LineStrips3D, Transform3D},
    datatypes::Quaternion,
};

use super::{
    joints::{JointSeries, TcpSeries},
    scalars::{log10, write_scalars},
};
use crate::rrd::{
    convert::{quaternion, vector},
    paths,
    times::{SampleTime, SampleTimes},
    writer::{RrdWriter, failed},
};

/// The most rows of a batch. A batch of any length adds some 2 kB to the footer for each entity.
pub(super) const MAX_ROWS: usize = 1000;

/// A pose in rerun's types.
#[derive(Debug, Clone, Copy)]
struct RerunPose {
    translation: [f32; 3],
    quaternion: Quaternion,
}

impl From<&Isometry3<f64>> for RerunPose {
    fn from(pose: &Isometry3<f64>) -> Self {
        Self { translation: vector(&pose.translation.vector), quaternion: quaternion(pose) }
    }
}

/// The columns of a batch; a column with several values in each row holds them one after another.
#[derive(Debug)]
pub(crate) struct SampleBatch {
    times: SampleTimes,
    twin: Vec<RerunPose>,
    model: Vec<RerunPose>,
    /// Poses of the obstacles that move, and their names.
    moving: Vec<RerunPose>,
    moving_names: Vec<String>,
    errors: Vec<PoseError>,
    q: Vec<f64>,
    joints: JointSeries,
    tcp: TcpSeries,
    tool: Vec<[f32; 3]>,
    /// The tool's position at the end of the previous batch, from which the trail continues.
    previous_tool: Option<[f32; 3]>,
}

impl SampleBatch {
    /// An empty batch for a robot with these names.
    pub(crate) fn new(names: &Names, moving_names: Vec<String>) -> Self {
        let poses = MAX_ROWS * names.links.len();
        Self {
            times: SampleTimes::with_capacity(MAX_ROWS),
            twin: Vec::with_capacity(poses),
            model: Vec::with_capacity(poses),
            moving: Vec::with_capacity(MAX_ROWS * moving_names.len()),
            moving_names,
            errors: Vec::with_capacity(poses),
            q: Vec::with_capacity(MAX_ROWS * names.joints.len()),
            joints: JointSeries::with_capacity(MAX_ROWS * names.joints.len()),
            tcp: TcpSeries::with_capacity(MAX_ROWS),
            tool: Vec::with_capacity(MAX_ROWS),
            previous_tool: None,
        }
    }

    /// Whether the batch must be written before the next row.
    pub(crate) fn is_full(&self) -> bool {
        self.times.len() >= MAX_ROWS
    }

    /// Adds a row; the poses of the TCP are by twin and by model.
    pub(crate) fn push(&mut self, time: SampleTime, sample: &Sample<'_>, tcp: [&Isometry3<f64>; 2]) {
        self.times.push(time);
        self.twin.extend(sample.twin.iter().map(RerunPose::from));
        self.model.extend(sample.model.iter().map(|pose: &Pose| RerunPose::from(&pose.to_isometry())));
        self.moving.extend(sample.bodies.poses().map(|(_, pose, _)| RerunPose::from(pose)));
        self.errors.extend_from_slice(sample.errors);
        self.q.extend_from_slice(sample.joints.state().q);
        self.joints.push(sample);
        let [twin, model] = tcp;
        self.tcp.push(twin, model);
        self.tool.push(vector(&twin.translation.vector));
    }

    /// Writes all rows and removes them.
    pub(crate) fn write(&mut self, writer: &mut RrdWriter, names: &Names) -> Result<(), RecordingError> {
        if self.times.is_empty() {
            return Ok(());
        }
        let times = self.times.columns();
        let links = names.links.len();
        // Samples one after another, each with all links: every `links`-th entry is of this one.
        for (index, link) in names.links.iter().enumerate() {
            let twin = self.twin.iter().skip(index).step_by(links);
            writer.columns(&paths::twin(link), &times, transforms(twin)?)?;
            let model = self.model.iter().skip(index).step_by(links);
            writer.columns(&paths::model(link), &times, transforms(model)?)?;
            let errors = || self.errors.iter().skip(index).step_by(links);
            let positions = errors().map(|error| error.position_m);
            write_scalars(writer, &paths::position_error(link), &times, positions)?;
            let orientations = errors().map(|error| error.orientation_rad);
            write_scalars(writer, &paths::orientation_error(link), &times, orientations)?;
        }
        for (index, name) in self.moving_names.iter().enumerate() {
            let poses = self.moving.iter().skip(index).step_by(self.moving_names.len());
            writer.columns(&paths::obstacle(name), &times, transforms(poses)?)?;
        }
        self.write_worst(writer, &times, links)?;
        for (index, joint) in names.joints.iter().enumerate() {
            let q = self.q.iter().skip(index).step_by(names.joints.len()).copied();
            write_scalars(writer, &paths::joint_position(joint), &times, q)?;
        }
        self.joints.write(writer, &times, self.times.len(), &names.joints)?;
        self.tcp.write(writer, &times)?;
        self.write_trail(writer, &times)?;
        self.clear();
        Ok(())
    }

    /// The largest errors as decimal logarithms: rounding errors and limits are many decades apart.
    fn write_worst(
        &self,
        writer: &mut RrdWriter,
        times: &[TimeColumn],
        links: usize,
    ) -> Result<(), RecordingError> {
        let worst = |value: fn(&PoseError) -> f64| {
            let rows = self.errors.chunks_exact(links.max(1));
            // Not `f64::max`, which drops a NaN: an error that is not a number would be drawn as none.
            rows.map(move |row| log10(row.iter().map(value).fold(0.0, larger)))
        };
        let position = worst(|error| error.position_m);
        write_scalars(writer, &paths::worst_of_links("position"), times, position)?;
        let orientation = worst(|error| error.orientation_rad);
        write_scalars(writer, &paths::worst_of_links("orientation"), times, orientation)
    }

    /// One line segment for each row, from the tool's position in the previous row.
    fn write_trail(&self, writer: &mut RrdWriter, times: &[TimeColumn]) -> Result<(), RecordingError> {
        // The first segment of all has no previous point: it begins and ends at the first one.
        let from =
            self.previous_tool.iter().chain(self.tool.first().filter(|_| self.previous_tool.is_none()));
        let segments = from.chain(&self.tool).zip(&self.tool).map(|(&from, &to)| [from, to]);
        let trail = LineStrips3D::update_fields().with_strips(segments);
        writer.columns(&paths::trail(), times, trail.columns_of_unit_batches().map_err(failed)?)
    }

    fn clear(&mut self) {
        self.previous_tool = self.tool.last().copied();
        self.times.clear();
        self.twin.clear();
        self.model.clear();
        self.moving.clear();
        self.errors.clear();
        self.q.clear();
        self.tool.clear();
    }
}

/// Poses as a column of transforms.
fn transforms<'a>(
    poses: impl Iterator<Item = &'a RerunPose> + Clone,
) -> Result<impl Iterator<Item = re_sdk_types::SerializedComponentColumn>, RecordingError> {
    Transform3D::update_fields()
        .with_many_translation(poses.clone().map(|pose| pose.translation))
        .with_many_quaternion(poses.map(|pose| pose.quaternion))
        .columns_of_unit_batches()
        .map_err(failed)
}
