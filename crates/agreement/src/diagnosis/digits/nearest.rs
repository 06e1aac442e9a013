//! The models nearest to each other within the digits of their files.

use congruent_description::{ChainQ, Tolerance};
use nalgebra::{DMatrix, DVector};

use super::{typed_value::TypedValue, written_digits::WrittenDigits};
use crate::diagnosis::{
    fit::evaluation_point::EvaluationPoint,
    hypothesis::ModelPair,
    thresholds::{
        BARRIER_END, BARRIER_FACTOR, BARRIER_STEP, BARRIER_STEPS, BOX_DAMPING, BOX_PASSES, DIGITS_MARGIN,
        ENOUGH, FIRST_ORDER_ERRORS, OUT_OF_REACH,
    },
};

/// The most that a value may be off, in half places. A value that is rounded from exactly the middle of two is off by half
/// a place, and the sum of two such values by twice that: without the margin, rounding of the last bit would decide.
const MOST: f64 = 1.0 + DIGITS_MARGIN;

impl WrittenDigits {
    /// Whether values within half of the last place of the typed ones make the models the same, up to the rounding of
    /// an `f64`, at these configurations.
    pub(crate) fn explain(&self, models: &ModelPair, configurations: &[ChainQ]) -> bool {
        self.explained(models, configurations).is_some()
    }

    /// The pair with values within half of the last place of the typed ones that are the same; `None` if there is none.
    pub(in crate::diagnosis) fn explained(
        &self,
        models: &ModelPair,
        configurations: &[ChainQ],
    ) -> Option<ModelPair> {
        if self.values.is_empty() {
            return None;
        }
        let same = Tolerance::default();
        let nearest = self.nearest(models);
        configurations.iter().all(|q| nearest.residual_at(q).is_within(&same)).then_some(nearest)
    }

    /// The pair with the values, each within half of its last place, that are nearest to agreement.
    fn nearest(&self, models: &ModelPair) -> ModelPair {
        let point = EvaluationPoint::for_reference(&models.reference);
        let mut parts = DVector::zeros(self.values.len());
        let mut nearest = models.clone();
        let mut rest = difference(&nearest, &point);
        let mut effects = self.effects_at(models, &parts, &point);
        let scale = effects.column_iter().map(|column| column.norm_squared()).fold(0.0, f64::max);
        // Lengths and angles that are multiplied with each other: at most all of them with all.
        let all: f64 = effects.column_iter().map(|column| column.norm()).sum();
        if is_out_of_reach(&effects, &rest, &rest, all * all) {
            return nearest;
        }
        let mut damping = BOX_DAMPING.first;
        // Levenberg and Marquardt: what the files have exactly aligned is so no longer after a step, and gives values a
        // thousandth of a millionth of their effect in new directions, which an undamped step would follow far.
        for _ in 0..BOX_PASSES {
            let next = bounded_step(&effects, &rest, &parts, damping * scale);
            let moved = self.shifted(models, &next);
            let moved_rest = difference(&moved, &point);
            let to_first_order = &rest + &effects * (&next - &parts);
            let second_order = FIRST_ORDER_ERRORS * (&moved_rest - &to_first_order).norm();
            let of_typed = &rest - &effects * &parts;
            if is_out_of_reach(&effects, &of_typed, &to_first_order, second_order) {
                break;
            }
            if moved_rest.norm() < rest.norm() {
                (nearest, parts, rest) = (moved, next, moved_rest);
                damping = (damping * BOX_DAMPING.after_success).max(BOX_DAMPING.least);
                effects = self.effects_at(models, &parts, &point);
            } else {
                damping *= BOX_DAMPING.after_failure;
            }
            if rest.norm() < ENOUGH || damping > BOX_DAMPING.most {
                break;
            }
        }
        nearest
    }

    /// The models with each value shifted by this part of half its last place.
    fn shifted(&self, models: &ModelPair, parts: &DVector<f64>) -> ModelPair {
        let mut shifted = models.clone();
        for (value, part) in self.values.iter().zip(parts.iter()) {
            value.shift(&mut shifted, part * value.half_place);
        }
        shifted
    }

    /// The change of the difference at `point` by half a place of each value: one column for each, to first order.
    pub(in crate::diagnosis) fn effects(&self, models: &ModelPair, point: &EvaluationPoint) -> DMatrix<f64> {
        self.effects_at(models, &DVector::zeros(self.values.len()), point)
    }

    /// The same with each value shifted by this part of half its last place.
    ///
    /// As changes of the shifts from the typed values: a pitch of 1.5708 is beyond a quarter turn, and on the other side of
    /// it its axis has the opposite direction.
    fn effects_at(&self, models: &ModelPair, parts: &DVector<f64>, point: &EvaluationPoint) -> DMatrix<f64> {
        let column = |(at, value): (usize, &TypedValue)| {
            let step = DIFFERENCE_STEP / value.half_place;
            let [up, down] = [step, -step].map(|by| {
                let mut moved = parts.clone();
                moved[at] += by;
                difference(&self.shifted(models, &moved), point)
            });
            (up - down) / (2.0 * step)
        };
        DMatrix::from_columns(&self.values.iter().enumerate().map(column).collect::<Vec<_>>())
    }
}

/// Step of the central differences. Unit: m or rad; kind: truncation, 2e-11 of an effect, and rounding, 1e-11. Differences
/// over half a place would have a part that no value has to first order, which a fit takes for an effect.
const DIFFERENCE_STEP: f64 = 1e-5;

/// The norm of the largest difference that values with these effects allow: all of them off by half a place to the worse
/// side.
pub(in crate::diagnosis) fn most_norm(effects: &DMatrix<f64>) -> f64 {
    let most = effects.row_iter().map(|row| row.iter().map(|effect| effect.abs()).sum::<f64>());
    DVector::from_iterator(effects.nrows(), most).norm()
}

fn difference(models: &ModelPair, point: &EvaluationPoint) -> DVector<f64> {
    let state = models.reference.state(&point.q);
    point.unweighted(&models.candidate, &models.candidate.walk(&point.q), &state).into()
}

/// Whether no values within their bounds bring the difference that the typed ones leave to zero, whose effects have at most
/// this error: along `direction` it is larger than what all of them together take away.
///
/// Source: the separating hyperplane of a point and a convex set, Boyd & Vandenberghe, *Convex Optimization* (2004), section
/// 2.5. The remaining difference of the nearest values is such a direction, if there is any.
fn is_out_of_reach(
    effects: &DMatrix<f64>,
    of_typed: &DVector<f64>,
    direction: &DVector<f64>,
    error: f64,
) -> bool {
    let taken_away = MOST * effects.tr_mul(direction).lp_norm(1);
    direction.dot(of_typed) - taken_away > (error + OUT_OF_REACH) * direction.norm()
}

/// The `x` with `|x_i| <= 1` at which `|A (x - x0) + r|^2 + d |x - x0|^2` is smallest: that without bounds, if it is within
/// them, otherwise by an interior-point method.
///
/// Source: Nocedal & Wright, *Numerical Optimization* (2006), section 16.6, with the slacks eliminated. Steps that stop at
/// the first bound (projected Newton) end before the minimum if many values are near theirs, and a difference that the
/// digits allow would count as one that they do not.
fn bounded_step(a: &DMatrix<f64>, rest: &DVector<f64>, from: &DVector<f64>, damping: f64) -> DVector<f64> {
    let mut equations = a * a.transpose();
    for at in 0..equations.nrows() {
        equations[(at, at)] += damping;
    }
    // A^T (A A^T + d)^-1: of the size of the difference, of which there are fewer numbers than values.
    let free = equations.cholesky().map(|factors| from - a.tr_mul(&factors.solve(rest)));
    if let Some(free) = free.filter(|free| free.amax() <= MOST) {
        return free;
    }
    let mut gram = a.tr_mul(a);
    for at in 0..gram.nrows() {
        gram[(at, at)] += damping;
    }
    let target = &gram * from - a.tr_mul(rest);
    interior_point(gram, target)
}

/// The minimum of `x^T G x / 2 - c^T x` within the bounds, up to the size of the barrier at its end.
fn interior_point(gram: DMatrix<f64>, target: DVector<f64>) -> DVector<f64> {
    let scale = gram.diagonal().max().max(f64::MIN_POSITIVE);
    let (gram, target) = (gram / scale, target / scale);
    let mut x = DVector::zeros(target.len());
    // Multipliers of the bounds above and below.
    let first = target.amax().max(BARRIER_END);
    let mut multipliers = [x.map(|_: f64| first), x.map(|_: f64| first)];
    for _ in 0..BARRIER_STEPS {
        let slacks = [x.map(|x: f64| MOST - x), x.map(|x: f64| MOST + x)];
        let complementarity = multipliers.iter().zip(&slacks).map(|(of, slack)| of.dot(slack)).sum::<f64>();
        #[expect(clippy::cast_precision_loss, reason = "files have few values")]
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

    /// That of the last pass.
    const DAMPING: f64 = BOX_DAMPING.least;

    /// The bounded solution of `A x = b`.
    fn bounded(a: &DMatrix<f64>, b: &DVector<f64>) -> DVector<f64> {
        bounded_step(a, &-b, &DVector::zeros(a.ncols()), DAMPING)
    }

    #[test]
    fn values_stop_at_their_bounds() {
        let a = DMatrix::from_row_slice(2, 3, &[1.0, 0.0, 1.0, 0.0, 1.0, 1.0]);
        // Within: exact.
        let b = DVector::from_vec(vec![0.3, 0.4]);
        let x = bounded(&a, &b);
        assert!((&a * &x - &b).norm() < 1e-9 && x.amax() <= 1.0 + DIGITS_MARGIN, "{x}");
        // Beyond: the nearest, at the bounds.
        let x = bounded(&a, &DVector::from_vec(vec![3.0, 0.0]));
        // By hand: with x1 = 1 the rest is (x3 - 2)^2 + (x2 + x3)^2, smallest at x3 = 1 and x2 = -1.
        let expected = DVector::from_vec(vec![1.0, -1.0, 1.0]) * (1.0 + DIGITS_MARGIN);
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
