//! All results of a calibration, as the input of the report.

use congruent_description::{RobotDescription, RobotQ};
use nalgebra::Matrix3;

use crate::{
    camera::{CameraMount, camera_from_target},
    chain::NominalChain,
    estimation::{
        CalibrationFit, CorrectedChain, HeldOut, Identification, Measurement, RobustFit, Suggestion,
    },
    measurements::MeasuredRow,
    options::CalibrationOptions,
};

/// All results of a calibration.
#[derive(Debug, Clone)]
pub(crate) struct Computed<'a> {
    pub(crate) description: &'a RobotDescription,
    pub(crate) options: &'a CalibrationOptions,
    pub(crate) nominal: NominalChain<'a>,
    pub(crate) chain: CorrectedChain,
    pub(crate) rows: &'a [MeasuredRow],
    pub(crate) measurements: Vec<Measurement>,
    pub(crate) identification: Identification,
    /// Degrees of freedom to verify the estimated corrections by.
    pub(crate) redundancy: usize,
    pub(crate) least_squares: CalibrationFit,
    pub(crate) robust: RobustFit,
    /// Outliers of the robust estimate; none if they would be more than half of the rows.
    pub(crate) outlier_rows: Vec<usize>,
    pub(crate) held_out: Option<HeldOut>,
    pub(crate) candidates: Vec<RobotQ>,
    pub(crate) next: Vec<Suggestion>,
}

/// A measured row as a measurement of the chain.
///
/// A camera in the hand turns it around: where the chain and the row together place the target, it must be in every row, so the
/// target is the origin of the frame of the measurements.
pub(crate) fn measurement(
    nominal: &NominalChain<'_>,
    row: &MeasuredRow,
    camera: Option<CameraMount>,
) -> Measurement {
    let q = nominal.chain_positions(&row.q);
    let in_hand = camera.filter(|mount| *mount == CameraMount::EyeInHand);
    match in_hand.and_then(|_| camera_from_target(row)) {
        Some(seen) => Measurement {
            q,
            tip_in_base_m: [Some(0.0); 3],
            base_from_tip: row.orientation.map(|_| Matrix3::identity()),
            camera_from_target: Some(seen),
        },
        None => Measurement {
            q,
            tip_in_base_m: row.tip_in_base_m,
            base_from_tip: row.orientation.map(|orientation| orientation.base_from_tip()),
            camera_from_target: None,
        },
    }
}

impl Computed<'_> {
    /// Whether the robust estimate is recommended, which it is if there is an outlier.
    pub(crate) fn is_robust_best(&self) -> bool {
        !self.outlier_rows.is_empty()
    }

    /// The recommended estimate: the robust one if there is an outlier, else least squares.
    pub(crate) fn best(&self) -> &CalibrationFit {
        if self.is_robust_best() { &self.robust.fit } else { &self.least_squares }
    }
}
