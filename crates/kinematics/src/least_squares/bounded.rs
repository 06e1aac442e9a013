//! Least squares whose unknowns have bounds.

use nalgebra::{DMatrix, DVector};

/// Steps of the interior-point method. Kind: loop bound; some twenty are needed.
const BARRIER_STEPS: usize = 60;

/// The barrier of a step, as part of the one that the multipliers have, and at its end, as part of the largest effect.
/// No unit; kind: solver. An angle of eight digits has 1e-10 of the effect of a length of three.
const BARRIER_FACTOR: f64 = 0.1;
const BARRIER_END: f64 = 1e-15;

/// The part of the distance to the nearest bound that a step goes. No unit; kind: solver, as in the literature.
const BARRIER_STEP: f64 = 0.995;

/// A linear least-squares problem whose unknowns are bounded: the difference `A (x - x0) + r`.
#[derive(Debug, Clone, Copy)]
pub struct BoundedLeastSquares<'a> {
    /// The matrix `A`: a column for each unknown.
    pub effects: &'a DMatrix<f64>,
    /// The difference `r` at `x0`.
    pub rest: &'a DVector<f64>,
    /// The point `x0`.
    pub from: &'a DVector<f64>,
    /// The largest size of each unknown.
    pub most: f64,
}

impl BoundedLeastSquares<'_> {
    /// The `x` within the bounds at which `|A (x - x0) + r|^2 + damping |x - x0|^2` is smallest: that without bounds, if it is
    /// within them, otherwise by an interior-point method.
    ///
    /// Source: Nocedal & Wright, *Numerical Optimization* (2006), section 16.6, with the slacks eliminated. Steps that stop
    /// at the first bound (projected Newton) end before the minimum if many unknowns are near theirs.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::least_squares::BoundedLeastSquares;
    /// use nalgebra::{DMatrix, DVector};
    /// // x + y = 3 with both at most 1.
    /// let (effects, rest) = (DMatrix::from_row_slice(1, 2, &[1.0, 1.0]), DVector::from_vec(vec![-3.0]));
    /// let from = DVector::zeros(2);
    /// let x = BoundedLeastSquares { effects: &effects, rest: &rest, from: &from, most: 1.0 }.nearest(1e-14);
    /// assert!((x[0] - 1.0).abs() < 1e-9 && (x[1] - 1.0).abs() < 1e-9);
    /// ```
    pub fn nearest(&self, damping: f64) -> DVector<f64> {
        let Self { effects: a, rest, from, most } = *self;
        let mut equations = a * a.transpose();
        for at in 0..equations.nrows() {
            equations[(at, at)] += damping;
        }
        // A^T (A A^T + d)^-1: of the size of the difference, which often has fewer numbers than there are unknowns.
        let free = equations.cholesky().map(|factors| from - a.tr_mul(&factors.solve(rest)));
        if let Some(free) = free.filter(|free| free.amax() <= most) {
            return free;
        }
        let mut gram = a.tr_mul(a);
        for at in 0..gram.nrows() {
            gram[(at, at)] += damping;
        }
        let target = &gram * from - a.tr_mul(rest);
        interior_point(gram, target, most)
    }
}

/// The minimum of `x^T G x / 2 - c^T x` within the bounds, up to the size of the barrier at its end.
fn interior_point(gram: DMatrix<f64>, target: DVector<f64>, most: f64) -> DVector<f64> {
    let scale = gram.diagonal().max().max(f64::MIN_POSITIVE);
    let (gram, target) = (gram / scale, target / scale);
    let mut x = DVector::zeros(target.len());
    // Multipliers of the bounds above and below.
    let first = target.amax().max(BARRIER_END);
    let mut multipliers = [x.map(|_: f64| first), x.map(|_: f64| first)];
    for _ in 0..BARRIER_STEPS {
        let slacks = [x.map(|x: f64| most - x), x.map(|x: f64| most + x)];
        let complementarity = multipliers.iter().zip(&slacks).map(|(of, slack)| of.dot(slack)).sum::<f64>();
        #[expect(clippy::cast_precision_loss, reason = "problems have few unknowns")]
        let barrier = BARRIER_FACTOR * complementarity / (2 * x.len()) as f64;
        if barrier < BARRIER_END {
            break;
        }
        let ratios = [0, 1].map(|side| multipliers[side].component_div(&slacks[side]));
        let pushes = slacks.each_ref().map(|slack| slack.map(|slack| barrier / slack));
        let mut equations = gram.clone();
        for at in 0..x.len() {
            equations[(at, at)] += ratios[0][at] + ratios[1][at];
        }
        let Some(factors) = equations.cholesky() else { break };
        let step = factors.solve(&(&target - &gram * &x - &pushes[0] + &pushes[1]));
        // A slack above shrinks by the step, the one below grows by it.
        let duals = [
            &pushes[0] - &multipliers[0] + ratios[0].component_mul(&step),
            &pushes[1] - &multipliers[1] - ratios[1].component_mul(&step),
        ];
        let steps = [(&slacks[0], -&step), (&slacks[1], step.clone())];
        let of_slacks = steps.iter().map(|(from, by)| most_of_step(from, by));
        let of_duals = multipliers.iter().zip(&duals).map(|(from, by)| most_of_step(from, by));
        let part = of_slacks.chain(of_duals).fold(1.0, f64::min);
        x += part * &step;
        for (multiplier, by) in multipliers.iter_mut().zip(&duals) {
            *multiplier += part * by;
        }
    }
    x
}

/// The part of a step that keeps positive values positive, less a little.
fn most_of_step(from: &DVector<f64>, by: &DVector<f64>) -> f64 {
    let parts = from.iter().zip(by.iter()).filter(|(_, by)| **by < 0.0).map(|(from, by)| -from / by);
    BARRIER_STEP * parts.fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    const DAMPING: f64 = 1e-14;
    const MOST: f64 = 1.0 + 1e-4;

    /// The bounded solution of `A x = b`.
    fn bounded(a: &DMatrix<f64>, b: &DVector<f64>) -> DVector<f64> {
        let from = DVector::zeros(a.ncols());
        BoundedLeastSquares { effects: a, rest: &-b, from: &from, most: MOST }.nearest(DAMPING)
    }

    #[test]
    fn values_stop_at_their_bounds() {
        let a = DMatrix::from_row_slice(2, 3, &[1.0, 0.0, 1.0, 0.0, 1.0, 1.0]);
        // Within: exact.
        let b = DVector::from_vec(vec![0.3, 0.4]);
        let x = bounded(&a, &b);
        assert!((&a * &x - &b).norm() < 1e-9 && x.amax() <= MOST, "{x}");
        // Beyond: the nearest, at the bounds.
        let x = bounded(&a, &DVector::from_vec(vec![3.0, 0.0]));
        // By hand: with x1 = 1 the rest is (x3 - 2)^2 + (x2 + x3)^2, smallest at x3 = 1 and x2 = -1.
        let expected = DVector::from_vec(vec![1.0, -1.0, 1.0]) * MOST;
        assert!((&x - &expected).amax() < 1e-6, "{x}");
    }

    /// Values near their bounds with effects of very different sizes, as lengths and angles of files have: the minimum is
    /// zero, since it was made so.
    #[test]
    fn what_values_near_their_bounds_allow_is_found() {
        let (rows, columns) = (40, 60);
        for seed in 0..30_u32 {
            let number = |at: usize| {
                let at = f64::from(u32::try_from(at).expect("it is small"));
                libm::sin(f64::from(seed * 7919) + 1.7 * at * at)
            };
            let size = |column: usize| [1.0, 0.1, 1e-4][column % 3];
            // Of rank 30, as six numbers of a twist have five degrees of freedom.
            let left = DMatrix::from_fn(rows, 30, |row, inner| number(row * 30 + inner));
            let right =
                DMatrix::from_fn(30, columns, |inner, column| number(9000 + inner * columns + column));
            let a = DMatrix::from_fn(rows, columns, |row, column| {
                (left.row(row) * right.column(column))[0] * size(column)
            });
            let expected =
                DVector::from_fn(columns, |at, _| if at % 4 == 0 { number(at).signum() } else { number(at) });
            let b = &a * &expected;
            let x = bounded(&a, &b);
            assert!(x.amax() <= MOST, "{seed}: {}", x.amax());
            // The damped sum is at its minimum at most what it is at `expected`, where the difference is zero. Worst seen 3e-10.
            let residual = (&a * &x - &b).norm();
            assert!(residual < DAMPING.sqrt() * expected.norm(), "{seed}: {residual}");
        }
    }
}
