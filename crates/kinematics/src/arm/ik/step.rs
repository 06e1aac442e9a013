//! One step of each method: computes the changes of the joints from the columns and the residual of the task.
//!
//! The damped step is that of `least_squares.rs` in its other form, `J^T (J J^T + lambda I)^-1 e`: six equations
//! however many joints there are, in a matrix of fixed size, since a step allocates nothing. The task has one unit
//! and the damping goes with the cost, so nothing is scaled.

use nalgebra::{Cholesky, Matrix6, Vector6};

/// Share of the cost that is added to the diagonal: large far from the target, at which the linear
/// model is poor, nothing at it, so that convergence is quadratic.
const DAMPING_PER_COST: f64 = 0.5;
/// Least damping, which keeps the matrix regular if the arm is singular. Kind: rounding; entries
/// of the matrix are about 1, its factorisation loses some `eps` of them.
const LEAST_DAMPING: f64 = 1e-12;
/// Directions whose singular value is below this share of the largest are not part of the
/// pseudo-inverse. Kind: rounding; singular values are found by their squares, to `sqrt(eps)`.
const SMALLEST_SINGULAR_SHARE: f64 = 1e-6;
/// Directions whose singular value is below this share of the largest are weak: the damped
/// pseudo-inverse corrects less than the whole error along them. At the reference case's arm, the weakest direction
/// of a position has 0.36 of the strongest, of a pose 0.20, so nothing is damped there.
const WEAK_SINGULAR_SHARE: f64 = 0.05;
/// Largest change of one joint in one step, rad or m: beyond it the linear model does not hold.
const LONGEST_STEP: f64 = 1.0;

/// The linearised task at one configuration: the input of every method.
pub(super) struct IkTask<'a> {
    pub(super) columns: &'a [Vector6<f64>],
    /// Joints that are kept at a limit which the residual pushes them beyond.
    pub(super) kept_at_limit: &'a [bool],
    pub(super) residual: &'a Vector6<f64>,
    pub(super) cost: f64,
}

impl IkTask<'_> {
    fn free_columns(&self) -> impl Iterator<Item = &Vector6<f64>> {
        self.columns
            .iter()
            .zip(self.kept_at_limit)
            .filter(|(_, kept_at_limit)| !**kept_at_limit)
            .map(|(column, _)| column)
    }

    /// `J J^T` over the joints that are free.
    fn gram(&self) -> Matrix6<f64> {
        let mut gram = Matrix6::zeros();
        for column in self.free_columns() {
            gram += column * column.transpose();
        }
        gram
    }

    /// Writes `change = J^T task` for free joints, and 0 for the others.
    fn spread(&self, task: &Vector6<f64>, change: &mut [f64]) {
        for ((change, column), &kept_at_limit) in change.iter_mut().zip(self.columns).zip(self.kept_at_limit)
        {
            *change = if kept_at_limit { 0.0 } else { column.dot(task) };
        }
    }
}

/// `J^T (J J^T + lambda I)^-1 e`, which is the step of least squares `(J^T J + lambda I)^-1 J^T e`.
pub(super) fn damped(task: &IkTask<'_>, change: &mut [f64]) {
    let mut gram = task.gram();
    // The identity J^T (J J^T + l I)^-1 = (J^T J + l I)^-1 J^T lets a 6 x 6 system replace one of the size of the arm.
    let damping = DAMPING_PER_COST * task.cost + LEAST_DAMPING;
    for at in 0..6 {
        gram[(at, at)] += damping;
    }
    // Only rounding can make the matrix indefinite; the gradient still descends then.
    match Cholesky::new(gram) {
        Some(factors) => task.spread(&factors.solve(task.residual), change),
        None => transposed(task, change),
    }
    // Shortened as a whole: cutting single joints would change the direction of the step.
    let longest = change.iter().fold(0.0, |longest: f64, change| longest.max(change.abs()));
    if longest > LONGEST_STEP {
        for change in change {
            *change *= LONGEST_STEP / longest;
        }
    }
}

/// `J^+ e = J^T (J J^T)^+ e`.
pub(super) fn pseudo_inverse(task: &IkTask<'_>, change: &mut [f64]) {
    through_directions(task, |_| 0.0, change);
}

/// The same with weak directions damped: for a singular value `s` below `w`, which is
/// [`WEAK_SINGULAR_SHARE`] of the largest, `1 / s` becomes `s / (s^2 + (1 - s^2 / w^2) (w / 2)^2)`. That is
/// `1 / s` at `w`, at most `1.16 / w`, and goes to 0 with `s`: joint speeds stay bounded through a
/// singular configuration, and errors still decay in every direction in which the arm can move.
///
/// Source: numerical filtering of Maciejewski & Klein, *Numerical Filtering for the Operation of Robotic
/// Manipulators through Kinematically Singular Configurations* (1988), with the varying damping of
/// Siciliano et al., *Robotics* (2009), section 3.5.1.
pub(super) fn damped_pseudo_inverse(task: &IkTask<'_>, change: &mut [f64]) {
    let square_share = WEAK_SINGULAR_SHARE * WEAK_SINGULAR_SHARE;
    through_directions(task, |of_largest| (square_share - of_largest).max(0.0) / 4.0, change);
}

/// `J^T sum_i u_i <u_i, e> / (s_i^2 + damping)` over the directions `u_i` of the task, in which the arm
/// has the singular values `s_i`; `damping` is given from and as a share of the largest square.
fn through_directions(task: &IkTask<'_>, damping: impl Fn(f64) -> f64, change: &mut [f64]) {
    // J J^T = U S^2 U^T is 6 x 6 for any number of joints: its eigenvectors are the left singular vectors of J and its
    // eigenvalues the squares of the singular values, so no decomposition of J itself is needed.
    let gram = task.gram();
    // Of a matrix that is not finite nalgebra would look for eigenvalues for ever; there is no step from such a configuration.
    if !gram.iter().all(|entry| entry.is_finite()) {
        return change.fill(0.0);
    }
    let eigen = gram.symmetric_eigen();
    let largest = eigen.eigenvalues.max();
    let smallest = largest * SMALLEST_SINGULAR_SHARE * SMALLEST_SINGULAR_SHARE;
    let mut along = eigen.eigenvectors.transpose() * task.residual;
    for (along, &eigenvalue) in along.iter_mut().zip(&eigen.eigenvalues) {
        let damped = eigenvalue + damping(eigenvalue / largest) * largest;
        *along = if eigenvalue > smallest { *along / damped } else { 0.0 };
    }
    task.spread(&(eigen.eigenvectors * along), change);
}

/// `alpha J^T e`, `alpha = <e, J J^T e> / |J J^T e|^2`.
pub(super) fn transposed(task: &IkTask<'_>, change: &mut [f64]) {
    // The gain minimises |e - alpha J J^T e|, the error that a linear arm would have after the step.
    let moved = task.gram() * task.residual;
    let square = moved.norm_squared();
    let gain = if square > 0.0 { task.residual.dot(&moved) / square } else { 0.0 };
    task.spread(&(task.residual * gain), change);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Kind: rounding of a few operations on numbers up to `1 / WEAK_SINGULAR_SHARE`; worst seen 3.6e-15; x3.
    const ROUNDING: f64 = 1.1e-14;

    /// The change of a joint that moves the second direction by `weak`, beside one that moves the first by 1.
    fn changed(step: fn(&IkTask<'_>, &mut [f64]), weak: f64) -> f64 {
        let columns = [Vector6::x(), Vector6::y() * weak];
        let residual = Vector6::x() + Vector6::y();
        let task = IkTask { columns: &columns, kept_at_limit: &[false; 2], residual: &residual, cost: 1.0 };
        let mut change = [f64::NAN; 2];
        step(&task, &mut change);
        assert!((change[0] - 1.0).abs() < ROUNDING, "the strong direction is as it is: {change:?}");
        change[1]
    }

    #[test]
    fn weak_directions_are_damped_and_others_are_not() {
        for weak in [1.0, 0.3, 0.06] {
            assert!((changed(damped_pseudo_inverse, weak) - 1.0 / weak).abs() < ROUNDING, "{weak}");
        }
        assert!((changed(pseudo_inverse, 0.01) - 100.0).abs() < 1e-9);
        let most = 1.16 / WEAK_SINGULAR_SHARE;
        let mut last = 1.0 / WEAK_SINGULAR_SHARE;
        for step in 1..=1000 {
            let weak = WEAK_SINGULAR_SHARE * (1.0 - f64::from(step) / 1000.0);
            let change = changed(damped_pseudo_inverse, weak);
            assert!(change > 0.0 || weak == 0.0, "it goes in the right direction at {weak}: {change}");
            assert!(change <= most && (change - last).abs() < 0.1, "no jump at {weak}: {last} to {change}");
            last = change;
        }
        assert!(last.abs() < ROUNDING, "nothing is asked of a direction without motion: {last}");
    }
}
