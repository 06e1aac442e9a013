//! Cross-validation: the residuals of an estimate on measurements that it has not used.

use super::{
    align::align,
    identify::identify,
    model::CorrectedChain,
    problem::{Measurement, PoseResidual, Problem},
};
use crate::estimation::configurations;

/// Most folds; with fewer configurations each is a fold.
pub const MOST_FOLDS: usize = 10;
/// Folds for an estimate that has not converged on all rows: enough to say that it explains none of the others.
pub const FOLDS_UNSETTLED: usize = 2;

/// Fewest configurations of which some can be held out. Kind: judgement: without one of two or three, the others determine other
/// corrections than all together, so what they predict says nothing about the estimate.
pub const FEWEST_CONFIGURATIONS: usize = 4;

/// How rows are held out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FoldOptions {
    /// Threshold of [`align`] and [`identify`]: base and tool are aligned, and the corrections identified, anew for each fold.
    pub threshold: f64,
    /// Most folds.
    pub most: usize,
}

/// Residuals of held-out rows, which the estimate had not used.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldOut {
    /// Number of folds, each held out once.
    pub folds: usize,
    /// Root mean square of the distances.
    pub position_m: f64,
    /// Root mean square of the angles.
    pub orientation_rad: f64,
    /// Residual of each row with the estimate that did not use it.
    pub residuals: Vec<PoseResidual>,
}

/// Holds out each fold once, estimates on the other rows and computes the residuals of the fold. Configuration i is in fold i
/// modulo the number of folds, so the result is deterministic. Rows that repeat a configuration are in its fold: otherwise the
/// estimate would have used that configuration.
///
/// `chain` starts at nominal. `estimate` gives the corrections from a problem and the corrections that it may estimate. `None` for fewer than
/// [`FEWEST_CONFIGURATIONS`].
pub fn held_out(
    chain: &CorrectedChain,
    measurements: &[Measurement],
    FoldOptions { threshold, most }: FoldOptions,
    mut estimate: impl FnMut(&Problem<'_>, &[usize]) -> Vec<f64>,
) -> Option<HeldOut> {
    let configuration_of = configurations(measurements);
    let count = configuration_of.iter().max().map_or(0, |last| last + 1);
    if count < FEWEST_CONFIGURATIONS {
        return None;
    }
    let folds = count.min(most);
    let nothing =
        PoseResidual { position_m: nalgebra::Vector3::zeros(), orientation_rad: nalgebra::Vector3::zeros() };
    let mut residuals = vec![nothing; measurements.len()];
    for fold in 0..folds {
        let rows = measurements.iter().zip(&configuration_of);
        let (held_out, used): (Vec<_>, Vec<_>) =
            // By configuration, modulo the folds: neighbouring rows of a sweep fall into different folds.
            rows.enumerate().partition(|(_, (_, configuration))| *configuration % folds == fold);
        let used: Vec<Measurement> = used.into_iter().map(|(_, (each, _))| each.clone()).collect();
        // Aligned anew, for the held-out rows would otherwise have taken part in where the frames are.
        let chain = align(chain, &used, threshold);
        let problem = Problem { chain: &chain, measurements: &used };
        // Identified anew on the remaining rows: what only the left-out configurations identify would otherwise
        // be estimated from noise.
        let corrections = estimate(&problem, &identify(&problem, threshold).kept);
        for (row, (measurement, _)) in held_out {
            residuals[row] = measurement.residual(&chain.base_from_tip(&measurement.q, &corrections));
        }
    }
    let (position_m, orientation_rad) = root_mean_squares(measurements, &residuals);
    Some(HeldOut { folds, position_m, orientation_rad, residuals })
}

/// Root mean squares over the rows, of the distances and of the angles.
pub(super) fn root_mean_squares(measurements: &[Measurement], residuals: &[PoseResidual]) -> (f64, f64) {
    let rows = || measurements.iter().zip(residuals);
    let positions = rows().filter(|(each, _)| each.position_count() > 0);
    let orientations = rows().filter(|(each, _)| each.orientation_count() > 0);
    (
        root_mean(positions.map(|(_, residual)| residual.position_m.norm_squared())),
        root_mean(orientations.map(|(_, residual)| residual.orientation_rad.norm_squared())),
    )
}

fn root_mean(squares: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = squares.fold((0.0, 0.0), |(sum, count), square| (sum + square, count + 1.0));
    if count > 0.0 { (sum / count).sqrt() } else { 0.0 }
}
