//! Weights of a difference of screws and tip: directions in which the digits of the files explain much count little.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use crate::diagnosis::thresholds::SAME_VALUE;

/// A symmetric matrix of weights, at most 1.
#[derive(Debug, Clone)]
pub(in crate::diagnosis) struct Weights(DMatrix<f64>);

impl Weights {
    /// The weights for typed values whose half places have these effects on the difference: one column for each value.
    ///
    /// With `A` the effects, rounding gives differences with the covariance `A A^T`.
    /// The weights are its inverse square root, `e (A A^T + e^2 I)^(-1/2)` (generalised least squares, Aitken 1935), so
    /// that what no digit explains has weight 1 and keeps the thresholds of exact files.
    pub(in crate::diagnosis) fn new(effects: &DMatrix<f64>) -> Self {
        let SymmetricEigen { eigenvalues, eigenvectors } = SymmetricEigen::new(effects * effects.transpose());
        let weight = |variance: f64| SAME_VALUE / libm::sqrt(variance.max(0.0) + SAME_VALUE * SAME_VALUE);
        let weights = DMatrix::from_diagonal(&eigenvalues.map(weight));
        Self(&eigenvectors * weights * eigenvectors.transpose())
    }

    /// The weighted difference.
    pub(in crate::diagnosis) fn apply(&self, difference: Vec<f64>) -> Vec<f64> {
        (&self.0 * DVector::from_vec(difference)).data.into()
    }
}
