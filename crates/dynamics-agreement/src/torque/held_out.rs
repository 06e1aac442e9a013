//! Are the torques of a source those of a chain of rigid bodies at all? Any parameters are fitted at half of the states; the
//! other half must agree.

use congruent_dynamics::DynamicsError;
use nalgebra::{DMatrix, DVector};

use super::{
    reduced_difference::{Weighted, weighted},
    states::SampledState,
};
use crate::{model::DynamicsModel, thresholds::IDENTIFIABLE};

/// Relative residuals of the torques at the fitted and at the held-out states.
pub(crate) fn fit_and_hold_out(
    model: &DynamicsModel,
    states: &[SampledState],
    reference: &[Vec<f64>],
) -> Result<[f64; 2], DynamicsError> {
    let Weighted { columns, candidate, reference } = weighted(model, states, reference)?;
    let difference = &reference - candidate;
    let n = model.frames.dof();
    let rows = |half: usize| -> Vec<usize> {
        // Every other state: both halves are drawn from the same distribution.
        (0..states.len()).filter(|at| at % 2 == half).flat_map(|at| at * n..(at + 1) * n).collect()
    };
    let [fitted, held_out] = [rows(0), rows(1)];
    let numbers = fit(&columns.select_rows(&fitted), &difference.select_rows(&fitted));
    Ok([fitted, held_out].map(|rows| {
        let residual = difference.select_rows(&rows) - columns.select_rows(&rows) * &numbers;
        residual.norm() / reference.select_rows(&rows).norm()
    }))
}

/// The parameter change of smallest norm that fits a difference.
fn fit(columns: &DMatrix<f64>, difference: &DVector<f64>) -> DVector<f64> {
    let zeros = DVector::zeros(columns.ncols());
    let factors = columns.clone().qr();
    let mut rotated = difference.clone();
    factors.q_tr_mul(&mut rotated);
    let rotated = rotated.rows(0, columns.ncols()).into_owned();
    let decomposition = factors.r().svd(true, true);
    // Directions below the rank stay at zero; fitting them would amplify rounding on the half that is held
    // out.
    let least = IDENTIFIABLE * decomposition.singular_values.max();
    decomposition.solve(&rotated, least).unwrap_or(zeros)
}
