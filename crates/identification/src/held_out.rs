//! Are the estimated parameters better on data that they were not estimated from?

use nalgebra::DVector;

use crate::{
    equations::{RecordedEquations, SummedRows},
    estimate::{estimate, float, is_in_fold, local, quadratic},
    unknowns::FreeUnknowns,
};

/// Parts of the time, each of which is left out once. Kind: choice.
pub(crate) const FOLDS: usize = 5;

/// The residual of the effort of a joint in data that were left out of the estimate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeldOutEffort {
    /// By the description, root mean square, N m or N; the delay of the efforts and constant efforts are those that fit it best, from the
    /// other parts of the time, since it says nothing about them.
    pub before: f64,
    /// By the parameters that were estimated from the other parts of the time, N m or N.
    pub after: f64,
    /// The recorded effort itself, N m or N.
    pub effort: f64,
    /// Rows.
    pub rows: usize,
}

/// The residual of each driven joint: each fifth of the time by the parameters of the other four.
pub(crate) fn held_out(equations: &RecordedEquations, free: &FreeUnknowns) -> Vec<HeldOutEffort> {
    let none = HeldOutSums::default();
    let mut sums = vec![none; equations.joints.len()];
    for fold in 0..FOLDS {
        let is_left_out = |block: usize| is_in_fold(block, fold, FOLDS);
        let known = |free: &FreeUnknowns| estimate(equations, free, |block| !is_left_out(block));
        let (Some(found), Some(described)) = (known(free), known(&FreeUnknowns::default())) else { continue };
        for (row, sum) in sums.iter_mut().enumerate() {
            let joint = &equations.joints[row];
            let SummedRows { gram, rows, .. } = joint.sum(is_left_out);
            let left = |x: &DVector<f64>| quadratic(&gram, &local(equations, row, x)).max(0.0);
            sum.before += left(&described.x);
            sum.after += left(&found.x);
            sum.effort += gram[(joint.effort_column(), joint.effort_column())];
            sum.rows += rows;
        }
    }
    let rms = |sum: f64, rows: usize| (sum / float(rows).max(1.0)).sqrt();
    let of = |sum: &HeldOutSums| HeldOutEffort {
        before: rms(sum.before, sum.rows),
        after: rms(sum.after, sum.rows),
        effort: rms(sum.effort, sum.rows),
        rows: sum.rows,
    };
    sums.iter().map(of).collect()
}

/// Sums of squares.
#[derive(Debug, Clone, Copy, Default)]
struct HeldOutSums {
    before: f64,
    after: f64,
    effort: f64,
    rows: usize,
}
