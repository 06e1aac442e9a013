//! Unknowns whose effects cannot be distinguished.

use nalgebra::DMatrix;

/// The part of the effect of an unknown that the ones before it do not have is at least this, as a square. No unit; kind: choice: a
/// thousandth of the effect; below it, noise of a thousandth makes one of the other.
const OWN_PART: f64 = 1e-6;

/// For each unknown, the ones before it of which its effect is a sum, if it is; `None` for one that has an effect of its own.
///
/// `gram` has the inner products of the effects.
pub(crate) fn dependent(gram: &DMatrix<f64>) -> Vec<Option<Vec<usize>>> {
    let n = gram.nrows();
    let mut found: Vec<Option<Vec<usize>>> = Vec::with_capacity(n);
    // Rows of the triangle of the independent ones.
    let mut independent: Vec<usize> = Vec::new();
    for at in 0..n {
        let own = gram[(at, at)];
        if own <= 0.0 {
            found.push(Some(Vec::new()));
            continue;
        }
        let part = gram.select_rows(&independent).select_columns(&independent);
        let shared = gram.select_rows(&independent).column(at).into_owned();
        let factors = part.cholesky().map(|factor| factor.solve(&shared));
        let factors = factors.unwrap_or_else(|| nalgebra::DVector::zeros(independent.len()));
        if own - factors.dot(&shared) > OWN_PART * own {
            found.push(None);
            independent.push(at);
            continue;
        }
        let counts = |(place, factor): &(usize, &f64)| {
            factor.powi(2) * gram[(independent[*place], independent[*place])] > OWN_PART * own
        };
        let others = factors.iter().enumerate().filter(counts).map(|(place, _)| independent[place]);
        found.push(Some(others.collect()));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_joint_that_moves_in_one_direction_has_one_constant() {
        // Velocity, sign and one at three velocities of one sign.
        let rows = DMatrix::from_row_slice(3, 3, &[0.5, 1.0, 1.0, 0.7, 1.0, 1.0, 0.9, 1.0, 1.0]);
        assert_eq!(dependent(&(rows.transpose() * rows)), [None, None, Some(vec![1])]);
    }
}
