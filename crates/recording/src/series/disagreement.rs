//! Model and twin where they disagree: arrows of true length point from the twin's links outside the limits to the
//! model's, and a label shows the error of the worst link.

use congruent_description::Tolerance;
use congruent_input::display::length_and_angle;
use congruent_kinematics::{PoseError, larger};
use congruent_monitors::{RecordingError, Sample};
use re_sdk_types::{
    SerializedComponentColumn,
    archetypes::{Arrows3D, Ellipsoids3D, Points3D},
    components::{FillMode, Radius},
};

use super::samples::MAX_ROWS;
use crate::{
    rrd::{
        convert::vector,
        paths,
        times::{SampleTime, SampleTimes},
        writer::{RrdWriter, failed},
    },
    scene::palette,
};

/// Thickness of an arrow on the screen.
const ARROW_UI_POINTS: f32 = 2.5;
/// Radius of the ball around the worst link: it marks links without shapes as well.
const MARKER_M: f32 = 0.05;
/// Height of the label above the origin of the worst link.
const LABEL_ABOVE_M: f32 = 0.07;

/// The larger of both errors divided by their limits; NaN is the largest of all.
fn ratio(error: &PoseError, limits: &Tolerance) -> f64 {
    larger(error.position_m / limits.position_m, error.orientation_rad / limits.orientation_rad)
}

/// The link with the largest error at one time.
#[derive(Debug, Clone, Copy)]
struct WorstLink {
    link: usize,
    error: PoseError,
    origin_in_world: [f32; 3],
}

/// Arrows and labels of the links outside the limits, until they are written.
#[derive(Debug)]
pub(crate) struct DisagreementSeries {
    limits: Tolerance,
    /// For each link, whether it was outside the limits in the row before; `None` before the first.
    is_outside: Vec<Option<bool>>,
    times: SampleTimes,
    /// Number of arrows at each time.
    arrows: Vec<u32>,
    origins: Vec<[f32; 3]>,
    vectors: Vec<[f32; 3]>,
    worst: Vec<Option<WorstLink>>,
}

impl DisagreementSeries {
    /// A series without rows, for a robot with this number of links.
    pub(crate) fn new(links: usize, limits: Tolerance) -> Self {
        Self {
            limits,
            is_outside: vec![None; links],
            times: SampleTimes::with_capacity(MAX_ROWS),
            arrows: Vec::with_capacity(MAX_ROWS),
            origins: Vec::with_capacity(MAX_ROWS * links),
            vectors: Vec::with_capacity(MAX_ROWS * links),
            worst: Vec::with_capacity(MAX_ROWS),
        }
    }

    /// Whether a link has crossed its limits since the row before.
    pub(crate) fn would_change(&self, errors: &[PoseError]) -> bool {
        let shown = self.is_outside.iter();
        shown.zip(errors).any(|(shown, error)| *shown != Some(!error.is_within(&self.limits)))
    }

    /// Adds a row, and marks the links outside the limits.
    pub(crate) fn push(&mut self, time: SampleTime, sample: &Sample<'_>, are_violating: &mut [bool]) {
        let had_arrows = self.is_outside.contains(&Some(true));
        let first = self.origins.len();
        let mut worst: Option<(f64, WorstLink)> = None;
        for (link, error) in sample.errors.iter().enumerate() {
            let is_outside = !error.is_within(&self.limits);
            self.is_outside[link] = Some(is_outside);
            if !is_outside {
                continue;
            }
            are_violating[link] = true;
            let (twin, model) = (&sample.twin[link].translation.vector, &sample.model[link].translation);
            let origin_in_world = vector(twin);
            self.origins.push(origin_in_world);
            self.vectors.push(vector(&(model - twin)));
            let ratio = ratio(error, &self.limits);
            if worst.is_none_or(|(known, _)| larger(known, ratio).to_bits() != known.to_bits()) {
                worst = Some((ratio, WorstLink { link, error: *error, origin_in_world }));
            }
        }
        let arrows = u32::try_from(self.origins.len() - first).unwrap_or(u32::MAX);
        // One empty row after the last arrows: the viewer shows the latest row, and arrows would otherwise remain.
        if arrows > 0 || had_arrows {
            self.times.push(time);
            self.arrows.push(arrows);
            self.worst.push(worst.map(|(_, worst)| worst));
        }
    }

    /// Writes colours and sizes that do not change.
    pub(crate) fn write_static(writer: &mut RrdWriter) -> Result<(), RecordingError> {
        let arrows = Arrows3D::update_fields()
            .with_colors([palette::OUTSIDE])
            .with_radii([Radius::new_ui_points(ARROW_UI_POINTS)]);
        writer.log_static(&paths::error_arrows(), &arrows)?;
        let marker =
            Ellipsoids3D::update_fields().with_colors([palette::MARKER]).with_fill_mode(FillMode::Solid);
        writer.log_static(&paths::worst_error(), &marker)?;
        let label = Points3D::update_fields()
            .with_colors([palette::NEUTRAL])
            .with_radii([Radius::new_ui_points(0.0)])
            .with_show_labels(true);
        writer.log_static(&paths::worst_error(), &label)
    }

    /// Writes all rows and removes them.
    pub(crate) fn write(&mut self, writer: &mut RrdWriter, links: &[String]) -> Result<(), RecordingError> {
        if !self.times.is_empty() {
            let times = self.times.columns();
            let lengths = self.arrows.iter().map(|&arrows| arrows as usize);
            let arrows = Arrows3D::update_fields().with_origins(&self.origins).with_vectors(&self.vectors);
            writer.columns(&paths::error_arrows(), &times, arrows.columns(lengths).map_err(failed)?)?;
            writer.columns(&paths::worst_error(), &times, self.worst(links)?)?;
        }
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
            .with_labels(shown().map(|worst| pose_error(&links[worst.link], &worst.error)));
        let markers = Ellipsoids3D::update_fields()
            .with_centers(shown().map(|worst| worst.origin_in_world))
            .with_half_sizes(shown().map(|_| [MARKER_M; 3]));
        let labels = labels.columns(lengths()).map_err(failed)?;
        Ok(labels.chain(markers.columns(lengths()).map_err(failed)?))
    }
}

/// A link with its position error, and its orientation error if that can be seen.
fn pose_error(link: &str, error: &PoseError) -> String {
    /// Orientation error from which the label shows it. Unit: rad. Kind: choice, what the eye can see.
    const VISIBLE: f64 = 1e-3;
    let angle_rad = if error.orientation_rad >= VISIBLE { error.orientation_rad } else { 0.0 };
    format!("{link}: {}", length_and_angle(error.position_m, angle_rad))
}
