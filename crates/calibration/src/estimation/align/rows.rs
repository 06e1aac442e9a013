//! Measured rows with the poses of the nominal tip, and how far they are off.

use congruent_kinematics::Pose;
use nalgebra::Vector3;

use crate::estimation::{
    problem::{Measurement, Noise, PoseResidual},
    robust::median,
};

/// A measured row with the pose of the nominal tip.
#[derive(Debug, Clone, Copy)]
pub(super) struct AlignmentRow<'a> {
    /// From the tip to the base instead, if a camera at the tip measured the row.
    pub(super) base_from_tip: Pose,
    pub(super) measured: &'a Measurement,
}

impl AlignmentRow<'_> {
    /// The measured point, if all three of its coordinates were measured.
    pub(super) fn point(&self) -> Option<Vector3<f64>> {
        let [Some(x), Some(y), Some(z)] = self.measured.tip_in_base_m else { return None };
        Some(Vector3::new(x, y, z))
    }
}

/// The residual of the median row in metres, an angle times the reach: gross errors in fewer than half of the rows do not
/// change it.
pub(super) fn median_size_m(residuals: &[PoseResidual], reach_m: f64) -> f64 {
    let alike = Noise { position_m: 1.0, orientation_rad: 1.0 / reach_m };
    median(residuals.iter().map(|each| each.whitened_squared(&alike)).collect()).sqrt()
}
