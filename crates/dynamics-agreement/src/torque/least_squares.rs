//! Linear least squares of few unknowns: a direction that nothing shows stays zero.

use nalgebra::{DMatrix, DVector};

use crate::thresholds::{FREE_AND_SEEN, ROUNDING, SEEN};

/// The shortest solution of a least squares problem.
pub(crate) struct Solution {
    pub(crate) unknowns: DVector<f64>,
    /// How many combinations of the unknowns have an effect.
    pub(crate) rank: usize,
}

/// Solves `columns x = target`; `scale` is the largest effect of all columns there are, below whose rounding a column
/// has none.
pub(crate) fn solve(columns: &DMatrix<f64>, target: &DVector<f64>, scale: f64) -> Solution {
    let decomposition = columns.clone().svd(true, true);
    let (Some(u), Some(v_t)) = (&decomposition.u, &decomposition.v_t) else {
        return Solution { unknowns: DVector::zeros(columns.ncols()), rank: 0 };
    };
    let values = &decomposition.singular_values;
    let least = (FREE_AND_SEEN * values.max()).max(ROUNDING * scale);
    let mut solution = Solution { unknowns: DVector::zeros(columns.ncols()), rank: 0 };
    for (at, &value) in values.iter().enumerate().filter(|(_, value)| **value > least) {
        let along = u.column(at).dot(target) / value;
        solution.unknowns += v_t.row(at).transpose() * along;
        solution.rank += 1;
    }
    solution
}

/// An orthonormal basis of what columns span.
pub(crate) fn basis(columns: &DMatrix<f64>, scale: f64) -> DMatrix<f64> {
    let decomposition = columns.clone().svd(true, false);
    let values = &decomposition.singular_values;
    let least = (SEEN * values.max()).max(ROUNDING * scale);
    let kept: Vec<usize> = (0..values.len()).filter(|&at| values[at] > least).collect();
    decomposition.u.map_or_else(|| DMatrix::zeros(columns.nrows(), 0), |u| u.select_columns(&kept))
}

/// What of a vector is outside of an orthonormal basis.
pub(crate) fn outside(basis: &DMatrix<f64>, vector: &DVector<f64>) -> DVector<f64> {
    let mut rest = vector.clone();
    // Twice is enough: Giraud, Langou, Rozloznik (2005).
    for _ in 0..2 {
        rest -= basis * basis.tr_mul(&rest);
    }
    rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_nothing_shows_stays() {
        let columns = DMatrix::from_row_slice(3, 2, &[1.0, 1.0, 2.0, 2.0, 0.0, 0.0]);
        let solution = solve(&columns, &DVector::from_vec(vec![2.0, 4.0, 0.0]), 1.0);
        assert_eq!(solution.rank, 1);
        assert!((solution.unknowns - DVector::from_vec(vec![1.0, 1.0])).norm() < 1e-14);
        let left = outside(&basis(&columns, 1.0), &DVector::from_vec(vec![1.0, 2.0, 5.0]));
        assert!((left - DVector::from_vec(vec![0.0, 0.0, 5.0])).norm() < 1e-14);
    }
}
