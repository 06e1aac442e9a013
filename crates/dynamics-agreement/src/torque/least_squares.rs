//! Linear least squares with few unknowns; directions that are not identifiable stay zero.

use nalgebra::{DMatrix, DVector};

use crate::thresholds::{FREE_AND_IDENTIFIABLE, IDENTIFIABLE, ROUNDING};

/// The least-squares solution of smallest norm.
pub(crate) struct SvdSolution {
    pub(crate) unknowns: DVector<f64>,
    /// Number of identifiable combinations of the unknowns.
    pub(crate) rank: usize,
}

/// Solves `columns x = target`; `scale` is the largest effect of any parameter, whose rounding is the smallest effect that
/// counts.
pub(crate) fn solve(columns: &DMatrix<f64>, target: &DVector<f64>, scale: f64) -> SvdSolution {
    let decomposition = columns.clone().svd(true, true);
    let (Some(u), Some(v_t)) = (&decomposition.u, &decomposition.v_t) else {
        return SvdSolution { unknowns: DVector::zeros(columns.ncols()), rank: 0 };
    };
    let values = &decomposition.singular_values;
    // The first term compares with these columns, the second with all: a single column of pure rounding would be
    // its own largest.
    let least = (FREE_AND_IDENTIFIABLE * values.max()).max(ROUNDING * scale);
    let mut solution = SvdSolution { unknowns: DVector::zeros(columns.ncols()), rank: 0 };
    for (at, &value) in values.iter().enumerate().filter(|(_, value)| **value > least) {
        let along = u.column(at).dot(target) / value;
        solution.unknowns += v_t.row(at).transpose() * along;
        solution.rank += 1;
    }
    solution
}

/// An orthonormal basis of the span of columns, by Gram-Schmidt with pivoting: the column with the largest remainder is next,
/// until only rounding remains. Singular vectors of rank-deficient columns are not accurate enough.
pub(crate) fn basis(columns: &DMatrix<f64>, scale: f64) -> DMatrix<f64> {
    let mut rest = columns.clone();
    let largest = |of: &DMatrix<f64>| {
        let norms = of.column_iter().map(|column| column.norm()).enumerate();
        norms.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0))
    };
    let least = (IDENTIFIABLE * largest(&rest).1).max(ROUNDING * scale);
    let mut found = DMatrix::zeros(columns.nrows(), 0);
    while found.ncols() < columns.ncols().min(columns.nrows()) {
        // Pivoting: the largest remaining column first, so that the rank is cut at the smallest ones.
        let (at, norm) = largest(&rest);
        if norm <= least {
            break;
        }
        // The chosen column has lost digits in earlier eliminations: it is made orthogonal to the basis again
        // before it is used.
        let direction = outside(&found, &(rest.column(at) / norm)).normalize();
        rest -= &direction * direction.tr_mul(&rest);
        let last = found.ncols();
        found = found.insert_column(last, 0.0);
        found.set_column(last, &direction);
    }
    found
}

/// The part of a vector orthogonal to an orthonormal basis.
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
    fn a_basis_of_columns_of_lower_rank_contains_them() {
        // Ten columns of rank three, two of which almost vanish, as those of a first joint.
        let of = |row: usize, column: usize| {
            let [x, y] = [row, column].map(|at| f64::from(u8::try_from(at).expect("small")));
            (x * 0.7).sin() * (y + 1.0) + (x * 1.3).cos() * (y * 0.9).sin() * 1e-4 + 1e-7 * (x * y).cos()
        };
        let columns = DMatrix::from_fn(40, 10, of) * DMatrix::from_fn(10, 10, of);
        let basis = basis(&columns, columns.amax());
        for column in columns.column_iter() {
            let column = column.into_owned();
            assert!(outside(&basis, &column).norm() <= 10.0 * IDENTIFIABLE * columns.amax());
        }
        let square = basis.tr_mul(&basis);
        assert!((&square - DMatrix::identity(square.nrows(), square.ncols())).amax() < 1e-14);
    }

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
