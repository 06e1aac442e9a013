//! Are the torques of a source those of a rigid body chain at all? Half of the states are fitted, with whatever numbers;
//! the other half must agree.

use congruent_dynamics::DynamicsError;
use nalgebra::{DMatrix, DVector};

use super::{
    compressed::{Weighted, weighted},
    states::State,
};
use crate::{side::Side, thresholds::SEEN};

/// What is left of the torques at the states that are fitted and at those that are held out, relative to the torques.
pub(crate) fn fit_and_hold_out(
    side: &Side,
    states: &[State],
    reference: &[Vec<f64>],
) -> Result<[f64; 2], DynamicsError> {
    let Weighted { columns, candidate, reference } = weighted(side, states, reference)?;
    let difference = &reference - candidate;
    let n = side.frames.dof();
    let rows = |half: usize| -> Vec<usize> {
        (0..states.len()).filter(|at| at % 2 == half).flat_map(|at| at * n..(at + 1) * n).collect()
    };
    let [fitted, held_out] = [rows(0), rows(1)];
    let numbers = fit(&columns.select_rows(&fitted), &difference.select_rows(&fitted));
    Ok([fitted, held_out].map(|rows| {
        let left = difference.select_rows(&rows) - columns.select_rows(&rows) * &numbers;
        left.norm() / reference.select_rows(&rows).norm()
    }))
}

/// The shortest numbers that explain a difference.
fn fit(columns: &DMatrix<f64>, difference: &DVector<f64>) -> DVector<f64> {
    let zeros = DVector::zeros(columns.ncols());
    let factors = columns.clone().qr();
    let mut rotated = difference.clone();
    factors.q_tr_mul(&mut rotated);
    let rotated = rotated.rows(0, columns.ncols()).into_owned();
    let decomposition = factors.r().svd(true, true);
    let least = SEEN * decomposition.singular_values.max();
    decomposition.solve(&rotated, least).unwrap_or(zeros)
}
