//! Samples gathered in columns until there are enough to be written in one go.

use congruent_kinematics::{Pose, PoseError};
use congruent_twin::{Sample, monitor::Names, recorder::RecordingError};
use nalgebra::{Isometry3, Point3};
use re_chunk::TimeColumn;
use re_sdk_types::{
    archetypes::{LineStrips3D, Scalars, Transform3D},
    datatypes::Quaternion,
};

use crate::{
    body::{quaternion, vector},
    paths,
    times::{Instant, Times},
    writer::{RrdWriter, failed},
};

/// Rows of a batch. Each batch costs some 2 kB of footer for each entity, whatever its length.
pub(super) const ROWS: usize = 1000;

/// A pose as rerun takes it.
#[derive(Debug, Clone, Copy)]
struct Placed {
    translation: [f32; 3],
    quaternion: Quaternion,
}

impl From<&Isometry3<f64>> for Placed {
    fn from(pose: &Isometry3<f64>) -> Self {
        Self { translation: vector(&pose.translation.vector), quaternion: quaternion(pose) }
    }
}

/// The columns; those with several values a row hold them one after another.
#[derive(Debug)]
pub(super) struct Batch {
    times: Times,
    twin: Vec<Placed>,
    model: Vec<Placed>,
    errors: Vec<PoseError>,
    q: Vec<f64>,
    tool: Vec<[f32; 3]>,
    /// The tool at the end of the batch before, where the trail goes on.
    tool_before: Option<[f32; 3]>,
}

impl Batch {
    /// Room for a batch about a robot with these names.
    pub(super) fn new(names: &Names) -> Self {
        let poses = ROWS * names.links.len();
        Self {
            times: Times::with_capacity(ROWS),
            twin: Vec::with_capacity(poses),
            model: Vec::with_capacity(poses),
            errors: Vec::with_capacity(poses),
            q: Vec::with_capacity(ROWS * names.joints.len()),
            tool: Vec::with_capacity(ROWS),
            tool_before: None,
        }
    }

    /// Whether the next row needs the batch written first.
    pub(super) fn is_full(&self) -> bool {
        self.times.len() >= ROWS
    }

    /// Adds a row.
    pub(super) fn push(&mut self, instant: Instant, sample: &Sample<'_>, tool_in_world: &Point3<f64>) {
        self.times.push(instant);
        self.twin.extend(sample.twin.iter().map(Placed::from));
        self.model.extend(sample.model.iter().map(|pose: &Pose| Placed::from(&pose.to_isometry())));
        self.errors.extend_from_slice(sample.errors);
        self.q.extend_from_slice(sample.q);
        self.tool.push(vector(&tool_in_world.coords));
    }

    /// Writes all rows and forgets them.
    pub(super) fn write(&mut self, writer: &mut RrdWriter, names: &Names) -> Result<(), RecordingError> {
        if self.times.is_empty() {
            return Ok(());
        }
        let times = self.times.columns();
        let links = names.links.len();
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
        self.write_worst(writer, &times, links)?;
        for (index, joint) in names.joints.iter().enumerate() {
            let q = self.q.iter().skip(index).step_by(names.joints.len()).copied();
            write_scalars(writer, &paths::joint_position(joint), &times, q)?;
        }
        self.write_trail(writer, &times)?;
        self.clear();
        Ok(())
    }

    /// The largest errors as powers of ten: rounding and limit are many decades apart.
    fn write_worst(
        &self,
        writer: &mut RrdWriter,
        times: &[TimeColumn],
        links: usize,
    ) -> Result<(), RecordingError> {
        let worst = |value: fn(&PoseError) -> f64| {
            let rows = self.errors.chunks_exact(links.max(1));
            rows.map(move |row| exponent(row.iter().map(value).fold(0.0, f64::max)))
        };
        let position = worst(|error| error.position_m);
        write_scalars(writer, &paths::worst_of_links("position"), times, position)?;
        let orientation = worst(|error| error.orientation_rad);
        write_scalars(writer, &paths::worst_of_links("orientation"), times, orientation)
    }

    /// One piece of line for each row, from where the tool was at the row before.
    fn write_trail(&self, writer: &mut RrdWriter, times: &[TimeColumn]) -> Result<(), RecordingError> {
        let from = self.tool_before.iter().chain(self.tool.first().filter(|_| self.tool_before.is_none()));
        let pieces = from.chain(&self.tool).zip(&self.tool).map(|(&from, &to)| [from, to]);
        let trail = LineStrips3D::update_fields().with_strips(pieces);
        writer.columns(&paths::trail(), times, trail.columns_of_unit_batches().map_err(failed)?)
    }

    fn clear(&mut self) {
        self.tool_before = self.tool.last().copied();
        self.times.clear();
        self.twin.clear();
        self.model.clear();
        self.errors.clear();
        self.q.clear();
        self.tool.clear();
    }
}

/// The power of ten of an error; below all rounding, there is no difference to no error at all.
pub(super) fn exponent(error: f64) -> f64 {
    const NOTHING: f64 = 1e-18;
    error.max(NOTHING).log10()
}

/// Writes one scalar for each instant.
pub(super) fn write_scalars(
    writer: &mut RrdWriter,
    path: &re_log_types::EntityPath,
    times: &[TimeColumn],
    values: impl Iterator<Item = f64>,
) -> Result<(), RecordingError> {
    writer.columns(path, times, Scalars::new(values).columns_of_unit_batches().map_err(failed)?)
}

fn transforms<'a>(
    poses: impl Iterator<Item = &'a Placed> + Clone,
) -> Result<impl Iterator<Item = re_sdk_types::SerializedComponentColumn>, RecordingError> {
    Transform3D::update_fields()
        .with_many_translation(poses.clone().map(|pose| pose.translation))
        .with_many_quaternion(poses.map(|pose| pose.quaternion))
        .columns_of_unit_batches()
        .map_err(failed)
}
