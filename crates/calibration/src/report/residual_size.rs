//! Residuals and corrections relative to the size of the arm: which are too large for measurement noise.

use crate::estimation::{CorrectedChain, CorrectionParameter, ParameterUnit, PoseResidual, Problem};

/// A residual above this share of the reach, or above this angle in rad, is too large for measurement noise. Kind: judgement: a
/// ruler reads to 1 %, a wrong unit, axis or frame gives tens of per cent.
const LARGE_SHARE: f64 = 0.03;
/// From this share on corrections must also at least halve the residuals. Kind: judgement; an arm whose
/// zeros are off by half a degree is off by a hundredth of its reach.
const NOTABLE_SHARE: f64 = 0.01;

/// From this share of the reach on, or from this angle in rad, a correction is suspicious. Kind: judgement: six
/// degrees are more than assembly errors, yet a zero may be a quarter turn off, so it only raises a question.
pub(super) const LARGE_CORRECTION: f64 = 0.1;

/// A correction of a length of the arm beyond this share of the reach is never recommended. Kind: judgement: no
/// assembly error is that large, a wrong table or file is.
pub(super) const LARGEST_LENGTH: f64 = 0.1;

/// The reach of an arm, which turns lengths into shares.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ReachScale {
    reach_m: f64,
}

/// Root mean square residual of the inliers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ResidualSize {
    pub(super) rms_m: f64,
    pub(super) rms_rad: f64,
    reach_m: f64,
}

impl ReachScale {
    pub(super) fn for_problem(problem: &Problem<'_>) -> Self {
        Self { reach_m: problem.reach_m() }
    }

    /// The largest correction of the arm, as a share of the reach or as an angle in rad; base and tool do not count, since they
    /// may be anywhere.
    pub(super) fn correction_size(self, chain: &CorrectedChain, corrections: &[f64]) -> f64 {
        let size = |(parameter, correction): (&CorrectionParameter, &f64)| match parameter.unit() {
            _ if parameter.entry.is_of_frame() => 0.0,
            ParameterUnit::Angle => correction.abs(),
            ParameterUnit::Length => correction.abs() / self.reach_m,
        };
        chain.parameters().iter().zip(corrections).map(size).fold(0.0, f64::max)
    }

    /// The length of the arm with the largest correction beyond a tenth of the reach, by its index.
    pub(super) fn too_large(self, chain: &CorrectedChain, corrections: &[f64]) -> Option<usize> {
        let is_length = |&at: &usize| {
            let parameter = &chain.parameters()[at];
            !parameter.entry.is_of_frame() && parameter.unit() == ParameterUnit::Length
        };
        let largest = (0..corrections.len())
            .filter(is_length)
            .max_by(|&a, &b| corrections[a].abs().total_cmp(&corrections[b].abs()));
        largest.filter(|&at| corrections[at].abs() > LARGEST_LENGTH * self.reach_m)
    }

    /// The residual of all rows except `outlier_rows`; of all rows if more than half are outliers, since then the estimate is
    /// wrong.
    pub(super) fn residual_size(self, residuals: &[PoseResidual], outlier_rows: &[usize]) -> ResidualSize {
        let outlier_rows = if 2 * outlier_rows.len() > residuals.len() { &[] } else { outlier_rows };
        let inliers = || residuals.iter().enumerate().filter(|(row, _)| !outlier_rows.contains(row));
        #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 rows")]
        let count = inliers().count().max(1) as f64;
        let root_mean = |squared_norm: fn(&PoseResidual) -> f64| {
            (inliers().map(|(_, each)| squared_norm(each)).sum::<f64>() / count).sqrt()
        };
        ResidualSize {
            rms_m: root_mean(|each| each.position_m.norm_squared()),
            rms_rad: root_mean(|each| each.orientation_rad.norm_squared()),
            reach_m: self.reach_m,
        }
    }

    /// The residual of the median row, which gross errors in fewer than half of the rows do not change.
    pub(super) fn median_residual_size(self, residuals: &[PoseResidual]) -> ResidualSize {
        let median = |norm: fn(&PoseResidual) -> f64| {
            let mut each: Vec<f64> = residuals.iter().map(norm).collect();
            each.sort_by(f64::total_cmp);
            each.get(each.len() / 2).copied().unwrap_or(0.0)
        };
        ResidualSize {
            rms_m: median(|each| each.position_m.norm()),
            rms_rad: median(|each| each.orientation_rad.norm()),
            reach_m: self.reach_m,
        }
    }
}

impl ResidualSize {
    /// The residual as a share of the reach or as an angle in rad, whichever is larger.
    pub(super) fn share(&self) -> f64 {
        (self.rms_m / self.reach_m).max(self.rms_rad)
    }

    /// Whether it is too large for measurement noise.
    pub(super) fn is_large(&self) -> bool {
        self.share() > LARGE_SHARE
    }

    /// Whether it is too large for noise, or large and hardly less than with the nominal model.
    pub(super) fn explains_nothing(&self, nominal: &Self) -> bool {
        self.is_large() || (self.share() > NOTABLE_SHARE && self.share() > nominal.share() / 2.0)
    }
}
