//! Weights of a difference of screws and tip: directions in which the digits of the files explain much count little.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::written_digits::WrittenDigits;
use crate::diagnosis::{
    fit::evaluation_point::EvaluationPoint,
    hypothesis::ModelPair,
    thresholds::{MOST_WEIGHTED_JOINTS, SAME_VALUE},
};

/// A symmetric matrix of weights, at most 1.
#[derive(Debug, Clone)]
pub(in crate::diagnosis) struct Weights(DMatrix<f64>);

impl Weights {
    /// The weights for typed values; `None` if all values are exact, or the chain is so long that a matrix costs more
    /// than it gives.
    ///
    /// With `A` the effects of half places on the difference, rounding gives differences with the covariance `A A^T`.
    /// The weights are its inverse square root, `e (A A^T + e^2 I)^(-1/2)` (generalised least squares, Aitken 1935), so
    /// that what no digit explains has weight 1 and keeps the thresholds of exact files.
    pub(in crate::diagnosis) fn new(
        digits: &WrittenDigits,
        models: &ModelPair,
        point: &EvaluationPoint,
    ) -> Option<Self> {
        if digits.values.is_empty() || point.q.len() > MOST_WEIGHTED_JOINTS {
            return None;
        }
        let effects = digits.effects(models, point);
        let SymmetricEigen { eigenvalues, eigenvectors } =
            SymmetricEigen::new(&effects * effects.transpose());
        let weight = |variance: f64| SAME_VALUE / libm::sqrt(variance.max(0.0) + SAME_VALUE * SAME_VALUE);
        let weights = DMatrix::from_diagonal(&eigenvalues.map(weight));
        Some(Self(&eigenvectors * weights * eigenvectors.transpose()))
    }

    /// The weighted difference.
    pub(in crate::diagnosis) fn apply(&self, difference: Vec<f64>) -> Vec<f64> {
        (&self.0 * DVector::from_vec(difference)).as_slice().to_vec()
    }
}
