//! What counts as explained: a residual against the size of the arm.

use crate::estimation::{CorrectedChain, Entry, Parameter, ParameterUnit, Problem, Residual};

/// What is left beyond this share of the reach, or as an angle in rad, is no noise of a measurement. Kind:
/// judgement: a ruler reads to 1 %, a slip of a unit, an axis or a frame leaves tens of per cent.
const LARGE_SHARE: f64 = 0.03;
/// From this share on corrections must also remove more than they leave. Kind: judgement; an arm whose
/// zeros are off by half a degree is off by a hundredth of its reach.
const NOTABLE_SHARE: f64 = 0.01;

/// From this share of the reach on, or from this angle in rad, a correction is doubted. Kind: judgement: six
/// degrees are more than assembly leaves, yet a zero may be a quarter turn off, so it is a doubt only.
pub(super) const LARGE_CORRECTION: f64 = 0.1;

/// The size of an arm, which turns lengths into shares.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ReachScale {
    reach_m: f64,
}

/// What is left of the rows that fit, root mean square.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Left {
    pub(super) rms_m: f64,
    pub(super) rms_rad: f64,
    pub(super) reach_m: f64,
}

impl ReachScale {
    pub(super) fn of(problem: &Problem<'_>) -> Self {
        Self { reach_m: problem.reach_m() }
    }

    /// The largest correction of the arm, as a share of the reach or as an angle; where it stands and what
    /// it holds may be anywhere.
    pub(super) fn size_of(self, chain: &CorrectedChain, corrections: &[f64]) -> f64 {
        let size = |(parameter, correction): (&Parameter, &f64)| match (parameter.entry, parameter.unit()) {
            (Entry::Base | Entry::Tool, _) => 0.0,
            (_, ParameterUnit::Angle) => correction.abs(),
            (_, ParameterUnit::Length) => correction.abs() / self.reach_m,
        };
        chain.parameters().iter().zip(corrections).map(size).fold(0.0, f64::max)
    }

    /// The residual of the rows besides `outlier_rows`; of all rows if those are more than half of them, since
    /// then it is the estimate that stands apart.
    pub(super) fn left(self, residuals: &[Residual], outlier_rows: &[usize]) -> Left {
        let outlier_rows = if 2 * outlier_rows.len() > residuals.len() { &[] } else { outlier_rows };
        let fitting = || residuals.iter().enumerate().filter(|(row, _)| !outlier_rows.contains(row));
        #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 rows")]
        let count = fitting().count().max(1) as f64;
        let root_mean =
            |of: fn(&Residual) -> f64| (fitting().map(|(_, each)| of(each)).sum::<f64>() / count).sqrt();
        Left {
            rms_m: root_mean(|each| each.position_m.norm_squared()),
            rms_rad: root_mean(|each| each.orientation_rad.norm_squared()),
            reach_m: self.reach_m,
        }
    }

    /// The same of the median row alone, which gross errors in fewer than half of the rows leave as it is.
    pub(super) fn of_median_row(self, residuals: &[Residual]) -> Left {
        let median = |of: fn(&Residual) -> f64| {
            let mut each: Vec<f64> = residuals.iter().map(of).collect();
            each.sort_by(f64::total_cmp);
            each.get(each.len() / 2).copied().unwrap_or(0.0)
        };
        Left {
            rms_m: median(|each| each.position_m.norm()),
            rms_rad: median(|each| each.orientation_rad.norm()),
            reach_m: self.reach_m,
        }
    }
}

impl Left {
    /// As a share of the reach, or as an angle, whichever is larger.
    pub(super) fn share(&self) -> f64 {
        (self.rms_m / self.reach_m).max(self.rms_rad)
    }

    /// No noise of a measurement is that large.
    pub(super) fn is_large(&self) -> bool {
        self.share() > LARGE_SHARE
    }

    /// Too much to be noise, or much and hardly less than before.
    pub(super) fn explains_nothing(&self, before: &Self) -> bool {
        self.is_large() || (self.share() > NOTABLE_SHARE && self.share() > before.share() / 2.0)
    }
}
