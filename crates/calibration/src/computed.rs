//! All results of a calibration, as the input of the report.

use congruent_description::{RobotDescription, RobotQ};

use crate::{
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
pub(crate) fn measurement(nominal: &NominalChain<'_>, row: &MeasuredRow) -> Measurement {
    Measurement {
        q: nominal.chain_positions(&row.q),
        tip_in_base_m: row.tip_in_base_m,
        base_from_tip: row.orientation.map(|orientation| orientation.base_from_tip()),
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
