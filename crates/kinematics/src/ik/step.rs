//! One step of each method: from the task's columns and residual to changes of the joints.

use nalgebra::{Cholesky, Matrix6, Vector6};

/// Share of the cost that is added to the diagonal: large far from the target, where the linear
/// model is poor, nothing at it, where convergence is quadratic.
const DAMPING_PER_COST: f64 = 0.5;
/// Least damping, which keeps the matrix regular where the arm is singular. Kind: rounding; entries
/// of the matrix are about 1, its factorisation loses some `eps` of them.
const LEAST_DAMPING: f64 = 1e-12;
/// Directions whose singular value is below this share of the largest are left out of the
/// pseudo-inverse. Kind: rounding; singular values are found by their squares, to `sqrt(eps)`.
const SMALLEST_SINGULAR_SHARE: f64 = 1e-6;
/// Longest change of one joint in one step, rad or m: beyond it the linear model says nothing.
const LONGEST_STEP: f64 = 1.0;

/// The arm at one configuration, as the rules see it.
pub(super) struct Task<'a> {
    pub(super) columns: &'a [Vector6<f64>],
    /// Joints that stand at a limit which the residual pushes them against.
    pub(super) held: &'a [bool],
    pub(super) residual: &'a Vector6<f64>,
    pub(super) cost: f64,
}

impl Task<'_> {
    fn free_columns(&self) -> impl Iterator<Item = &Vector6<f64>> {
        self.columns.iter().zip(self.held).filter(|(_, held)| !**held).map(|(column, _)| column)
    }

    /// `J J^T` over the joints that are free.
    fn gram(&self) -> Matrix6<f64> {
        let mut gram = Matrix6::zeros();
        for column in self.free_columns() {
            gram += column * column.transpose();
        }
        gram
    }

    /// `change = J^T task`, free joints alone.
    fn spread(&self, task: &Vector6<f64>, change: &mut [f64]) {
        for ((change, column), &held) in change.iter_mut().zip(self.columns).zip(self.held) {
            *change = if held { 0.0 } else { column.dot(task) };
        }
    }
}

/// `J^T (J J^T + lambda I)^-1 e`, which is the step of least squares `(J^T J + lambda I)^-1 J^T e`.
pub(super) fn damped(task: &Task<'_>, change: &mut [f64]) {
    let mut gram = task.gram();
    let damping = DAMPING_PER_COST * task.cost + LEAST_DAMPING;
    for at in 0..6 {
        gram[(at, at)] += damping;
    }
    match Cholesky::new(gram) {
        Some(factors) => task.spread(&factors.solve(task.residual), change),
        None => transposed(task, change),
    }
    let longest = change.iter().fold(0.0, |longest: f64, change| longest.max(change.abs()));
    if longest > LONGEST_STEP {
        for change in change {
            *change *= LONGEST_STEP / longest;
        }
    }
}

/// `J^+ e = J^T (J J^T)^+ e`.
pub(super) fn pseudo_inverse(task: &Task<'_>, change: &mut [f64]) {
    let eigen = task.gram().symmetric_eigen();
    let smallest = eigen.eigenvalues.max() * SMALLEST_SINGULAR_SHARE * SMALLEST_SINGULAR_SHARE;
    let mut along = eigen.eigenvectors.transpose() * task.residual;
    for (along, &eigenvalue) in along.iter_mut().zip(&eigen.eigenvalues) {
        *along = if eigenvalue > smallest { *along / eigenvalue } else { 0.0 };
    }
    task.spread(&(eigen.eigenvectors * along), change);
}

/// `alpha J^T e`, `alpha = <e, J J^T e> / |J J^T e|^2`.
pub(super) fn transposed(task: &Task<'_>, change: &mut [f64]) {
    let moved = task.gram() * task.residual;
    let square = moved.norm_squared();
    let gain = if square > 0.0 { task.residual.dot(&moved) / square } else { 0.0 };
    task.spread(&(task.residual * gain), change);
}
