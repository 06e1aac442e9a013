//! Levenberg-Marquardt steps: normal equations from the columns of a Jacobian, damped and solved. Each caller decides whether
//! to accept a step and when the iteration ends.

mod bounded;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

pub use bounded::BoundedLeastSquares;

/// The damping of a step: larger values give shorter steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Damping {
    /// Part of each diagonal entry that is added to it: independent of the units of the unknowns.
    pub relative: f64,
    /// Value that is added to each diagonal entry in addition. It makes the equations regular if an unknown has no effect; this
    /// unknown then keeps its value.
    pub absolute: f64,
}

/// The equations `J^T J x = -J^T r` of a step `x` that makes the residual `r + J x` as short as possible.
///
/// # Examples
/// A straight line through three points: the residuals are those of the line `y = 0`.
/// ```
/// use congruent_kinematics::least_squares::{Damping, NormalEquations};
/// let (offset, slope) = ([1.0, 1.0, 1.0], [0.0, 1.0, 2.0]);
/// let equations = NormalEquations::from_columns(&[offset, slope], &[-1.0, -3.0, -5.0]);
/// let step = equations.damped_step(Damping { relative: 0.0, absolute: 0.0 }).unwrap();
/// assert!((step[0] - 1.0).abs() < 1e-14 && (step[1] - 2.0).abs() < 1e-14);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct NormalEquations {
    /// `J^T J`, symmetric and positive semidefinite.
    pub information: DMatrix<f64>,
    /// The negative gradient `-J^T r`.
    pub right_side: DVector<f64>,
}

impl NormalEquations {
    /// From the columns of a Jacobian, one for each unknown, and the residual.
    pub fn from_columns(columns: &[impl AsRef<[f64]>], residual: &[f64]) -> Self {
        let column = |at: usize| columns[at].as_ref();
        Self {
            information: DMatrix::from_fn(columns.len(), columns.len(), |row, at| {
                dot(column(row), column(at))
            }),
            right_side: DVector::from_fn(columns.len(), |row, _| -dot(column(row), residual)),
        }
    }

    /// The step of the damped equations; `None` if they are singular.
    pub fn damped_step(&self, damping: Damping) -> Option<DVector<f64>> {
        damped_step(&self.information, &self.right_side, damping)
    }
}

/// Solves `(H + relative diag H + absolute I) x = g` for the step `x`; `None` if the matrix is not positive
/// definite.
///
/// Source: Marquardt, *An Algorithm for Least-Squares Estimation of Nonlinear Parameters* (1963), eq. 27.
pub fn damped_step(
    information: &DMatrix<f64>,
    right_side: &DVector<f64>,
    damping: Damping,
) -> Option<DVector<f64>> {
    let mut damped = information.clone();
    for at in 0..damped.nrows() {
        damped[(at, at)] = damped[(at, at)] * (1.0 + damping.relative) + damping.absolute;
    }
    Some(BalancedCholesky::new(damped)?.solve(right_side))
}

/// A Cholesky factor of a matrix whose rows and columns were scaled to a unit diagonal first, so that radians and
/// metres do not cost digits.
///
/// Source: van der Sluis, *Condition numbers and equilibration of matrices* (1969).
#[derive(Debug, Clone)]
pub struct BalancedCholesky {
    scale: DVector<f64>,
    factor: Cholesky<f64, Dyn>,
}

impl BalancedCholesky {
    /// The factor of a symmetric matrix; `None` if the matrix is not positive definite.
    pub fn new(mut matrix: DMatrix<f64>) -> Option<Self> {
        // A zero diagonal entry has no scale; left at 1, the factorisation finds that the matrix is not positive definite.
        let scale = matrix.diagonal().map(|entry| if entry > 0.0 { 1.0 / entry.sqrt() } else { 1.0 });
        for row in 0..matrix.nrows() {
            for column in 0..matrix.ncols() {
                matrix[(row, column)] *= scale[row] * scale[column];
            }
        }
        Some(Self { scale, factor: matrix.cholesky()? })
    }

    /// The solution for one right side.
    pub fn solve(&self, right_side: &DVector<f64>) -> DVector<f64> {
        // With D = diag(scale): A x = b is (D A D) (D^-1 x) = D b, hence the scale before and after.
        self.factor.solve(&right_side.component_mul(&self.scale)).component_mul(&self.scale)
    }

    /// The inverse of the matrix.
    pub fn inverse(&self) -> DMatrix<f64> {
        let mut inverse = DMatrix::identity(self.scale.len(), self.scale.len());
        for at in 0..inverse.ncols() {
            let column = self.solve(&inverse.column(at).into_owned());
            inverse.set_column(at, &column);
        }
        inverse
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_that_changes_nothing_stays_and_equations_without_damping_are_refused() {
        let equations = NormalEquations::from_columns(&[[2.0, 0.0], [0.0, 0.0]], &[-4.0, 1.0]);
        let step = equations.damped_step(Damping { relative: 0.0, absolute: 1e-15 }).unwrap();
        assert!((step[0] - 2.0).abs() < 1e-14 && step[1].abs() < f64::MIN_POSITIVE, "{step}");
        assert!(equations.damped_step(Damping { relative: 0.0, absolute: 0.0 }).is_none());
    }

    #[test]
    fn units_that_differ_by_nine_digits_cost_none() {
        /// Rounding of two products; worst seen 2e-16.
        const ROUNDING: f64 = 1e-15;
        let matrix = DMatrix::from_row_slice(2, 2, &[4e18, 2e9, 2e9, 3.0]);
        let inverse = BalancedCholesky::new(matrix.clone()).unwrap().inverse();
        let product = matrix * inverse;
        assert!((product[(0, 0)] - 1.0).abs() < ROUNDING && (product[(1, 1)] - 1.0).abs() < ROUNDING);
    }
}
