//! Everything that a calibration has computed, before it is put into words.

use congruent_description::{RobotDescription, RobotQ};

use crate::{
    chain::NominalChain,
    estimation::{CorrectedChain, Fit, HeldOut, Identification, Measurement, RobustFit, Suggestion},
    measurements::MeasuredRow,
    options::CalibrationOptions,
    report::Recommendation,
};

/// Everything that was computed, before it is put into words.
#[derive(Debug, Clone)]
pub(crate) struct Computed<'a> {
    pub(crate) description: &'a RobotDescription,
    pub(crate) options: &'a CalibrationOptions,
    pub(crate) nominal: NominalChain<'a>,
    pub(crate) chain: CorrectedChain,
    pub(crate) rows: &'a [MeasuredRow],
    pub(crate) measurements: Vec<Measurement>,
    pub(crate) identification: Identification,
    /// Measured components beyond those that the estimated corrections need.
    pub(crate) redundancy: usize,
    pub(crate) least_squares: Fit,
    pub(crate) robust: RobustFit,
    /// Rows that stand apart from the others; none where they would be more than half.
    pub(crate) outlier_rows: Vec<usize>,
    pub(crate) held_out: Option<HeldOut>,
    pub(crate) candidates: Vec<RobotQ>,
    pub(crate) next: Vec<Suggestion>,
}

/// A row as the chain sees it.
pub(crate) fn measurement(nominal: &NominalChain<'_>, row: &MeasuredRow) -> Measurement {
    Measurement {
        q: nominal.of_configuration(&row.q),
        tip_in_base_m: row.tip_in_base_m,
        base_from_tip: row.orientation.map(|orientation| orientation.base_from_tip()),
    }
}

impl Computed<'_> {
    /// The estimate that the words are about: the robust one as soon as a row stands apart.
    pub(crate) fn best(&self) -> (&Fit, Recommendation) {
        if self.outlier_rows.is_empty() {
            (&self.least_squares, Recommendation::LeastSquares)
        } else {
            (&self.robust.fit, Recommendation::Robust)
        }
    }
}
