//! What shows a disagreement before it is read: links turn red, arrows lead from the twin's links
//! to the model's in true length, and the worst link carries its error as a label.

use congruent_kinematics::PoseError;
use congruent_twin::{Sample, monitor::Check, recorder::RecordingError};
use re_log_types::EntityPath;
use re_sdk_types::{
    SerializedComponentBatch, SerializedComponentColumn,
    archetypes::{Arrows3D, Ellipsoids3D, Points3D},
    components::{FillMode, Radius},
};

use crate::{
    body::{Body, Paint, vector},
    palette, paths,
    times::{Instant, Times},
    units,
    writer::{RrdWriter, failed},
};

/// Thickness of an arrow, as wide on the screen at any distance.
const ARROW_UI_POINTS: f32 = 2.5;
/// Radius of the ball around the worst link: it shows also where a link has no shape.
const HALO_M: f32 = 0.05;
/// The label stands above the ball.
const LABEL_ABOVE_M: f32 = 0.07;

/// From where on model and twin disagree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct AgreementLimits {
    /// Distance of the origins.
    pub(super) position_m: f64,
    /// Angle between the orientations.
    pub(super) orientation_rad: f64,
}

impl AgreementLimits {
    /// The tightest limits of all checks; `None` where no check looks at agreement.
    pub(super) fn of(checks: &[Check]) -> Option<Self> {
        let limits = checks.iter().filter_map(|check| {
            let settings = check.monitor.resolved();
            let limit = |key| settings.get(key).and_then(toml::Value::as_float);
            Some(Self { position_m: limit("position_m")?, orientation_rad: limit("orientation_rad")? })
        });
        limits.reduce(|a, b| Self {
            position_m: a.position_m.min(b.position_m),
            orientation_rad: a.orientation_rad.min(b.orientation_rad),
        })
    }

    /// Whether an error is outside; no number is.
    fn excludes(&self, error: &PoseError) -> bool {
        let is_within = error.position_m <= self.position_m && error.orientation_rad <= self.orientation_rad;
        !is_within
    }

    /// How many times its limit an error is.
    fn ratio(&self, error: &PoseError) -> f64 {
        (error.position_m / self.position_m).max(error.orientation_rad / self.orientation_rad)
    }
}

/// A link that came to be outside its limits, or back.
#[derive(Debug, Clone, Copy)]
struct Change {
    link: usize,
    instant: Instant,
    is_outside: bool,
}

/// The worst link of an instant.
#[derive(Debug, Clone, Copy)]
struct Worst {
    link: usize,
    error: PoseError,
    origin_in_world: [f32; 3],
}

/// Gathers what there is to show until it is written.
#[derive(Debug)]
pub(super) struct Disagreement {
    limits: AgreementLimits,
    /// As shown; `None` before the first sample.
    is_outside: Vec<Option<bool>>,
    changes: Vec<Change>,
    times: Times,
    /// Arrows of each instant, one instant after another.
    arrows: Vec<u32>,
    origins: Vec<[f32; 3]>,
    vectors: Vec<[f32; 3]>,
    worst: Vec<Option<Worst>>,
}

impl Disagreement {
    /// Nothing to show yet, for a robot with so many links.
    pub(super) fn new(links: usize, limits: AgreementLimits) -> Self {
        Self {
            limits,
            is_outside: vec![None; links],
            changes: Vec::with_capacity(links),
            times: Times::default(),
            arrows: Vec::new(),
            origins: Vec::new(),
            vectors: Vec::new(),
            worst: Vec::new(),
        }
    }

    /// Whether these errors change the colour of a link.
    pub(super) fn would_change(&self, errors: &[PoseError]) -> bool {
        let shown = self.is_outside.iter();
        shown.zip(errors).any(|(shown, error)| *shown != Some(self.limits.excludes(error)))
    }

    /// Adds a row.
    pub(super) fn push(&mut self, instant: Instant, sample: &Sample<'_>) {
        let had_arrows = self.is_outside.contains(&Some(true));
        let first = self.origins.len();
        let mut worst: Option<(f64, Worst)> = None;
        for (link, error) in sample.errors.iter().enumerate() {
            let is_outside = self.limits.excludes(error);
            if self.is_outside[link] != Some(is_outside) {
                self.is_outside[link] = Some(is_outside);
                self.changes.push(Change { link, instant, is_outside });
            }
            if !is_outside {
                continue;
            }
            let (twin, model) = (&sample.twin[link].translation.vector, &sample.model[link].translation);
            let origin_in_world = vector(twin);
            self.origins.push(origin_in_world);
            self.vectors.push(vector(&(model - twin)));
            let ratio = self.limits.ratio(error);
            if worst.is_none_or(|(known, _)| ratio > known) {
                worst = Some((ratio, Worst { link, error: *error, origin_in_world }));
            }
        }
        let arrows = u32::try_from(self.origins.len() - first).unwrap_or(u32::MAX);
        if arrows > 0 || had_arrows {
            self.times.push(instant);
            self.arrows.push(arrows);
            self.worst.push(worst.map(|(_, worst)| worst));
        }
    }

    /// What looks the same all along.
    pub(super) fn write_static(writer: &mut RrdWriter) -> Result<(), RecordingError> {
        let arrows = Arrows3D::update_fields()
            .with_colors([palette::OUTSIDE])
            .with_radii([Radius::new_ui_points(ARROW_UI_POINTS)]);
        writer.log_static(&paths::error_arrows(), &arrows)?;
        let halo = Ellipsoids3D::update_fields().with_colors([palette::HALO]).with_fill_mode(FillMode::Solid);
        writer.log_static(&paths::worst_error(), &halo)?;
        let label = Points3D::update_fields()
            .with_colors([palette::MINIMUM])
            .with_radii([Radius::new_ui_points(0.0)])
            .with_show_labels(true);
        writer.log_static(&paths::worst_error(), &label)
    }

    /// Writes all rows and forgets them.
    pub(super) fn write(
        &mut self,
        writer: &mut RrdWriter,
        links: &[String],
        bodies: &[Body],
    ) -> Result<(), RecordingError> {
        for (link, name) in links.iter().enumerate() {
            self.write_colors(writer, link, &bodies[link], &paths::twin(name))?;
        }
        if !self.times.is_empty() {
            let times = self.times.columns();
            let lengths = self.arrows.iter().map(|&arrows| arrows as usize);
            let arrows = Arrows3D::update_fields().with_origins(&self.origins).with_vectors(&self.vectors);
            writer.columns(&paths::error_arrows(), &times, arrows.columns(lengths).map_err(failed)?)?;
            writer.columns(&paths::worst_error(), &times, self.worst(links)?)?;
        }
        self.changes.clear();
        self.times.clear();
        self.arrows.clear();
        self.origins.clear();
        self.vectors.clear();
        self.worst.clear();
        Ok(())
    }

    fn worst(
        &self,
        links: &[String],
    ) -> Result<impl Iterator<Item = SerializedComponentColumn>, RecordingError> {
        let shown = || self.worst.iter().flatten();
        let lengths = || self.worst.iter().map(|worst| usize::from(worst.is_some()));
        let above = |[x, y, z]: [f32; 3]| [x, y, z + LABEL_ABOVE_M];
        let labels = Points3D::update_fields()
            .with_positions(shown().map(|worst| above(worst.origin_in_world)))
            .with_labels(shown().map(|worst| units::disagreement(&links[worst.link], &worst.error)));
        let halos = Ellipsoids3D::update_fields()
            .with_centers(shown().map(|worst| worst.origin_in_world))
            .with_half_sizes(shown().map(|_| [HALO_M; 3]));
        let labels = labels.columns(lengths()).map_err(failed)?;
        Ok(labels.chain(halos.columns(lengths()).map_err(failed)?))
    }

    fn write_colors(
        &self,
        writer: &mut RrdWriter,
        link: usize,
        body: &Body,
        path: &EntityPath,
    ) -> Result<(), RecordingError> {
        let mut times = Times::default();
        // One column for each colour component, whose pieces are the rows.
        let mut columns: Vec<(EntityPath, Vec<Vec<SerializedComponentBatch>>)> = Vec::new();
        for change in self.changes.iter().filter(|change| change.link == link) {
            times.push(change.instant);
            let paint = if change.is_outside { Paint::Plain(palette::OUTSIDE) } else { Paint::Own };
            for (index, (path, parts)) in body.colors(path, paint).into_iter().enumerate() {
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

/// Rows that all have the same components, as columns.
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
