//! The models nearest to each other within the digits of their files.

use congruent_description::{ChainQ, Tolerance};
use nalgebra::{DMatrix, DVector};

use super::written_digits::WrittenDigits;
use crate::diagnosis::{
    fit::evaluation_point::EvaluationPoint,
    hypothesis::ModelPair,
    thresholds::{BOX_DAMPING, BOX_PASSES, BOX_STEPS, DIGITS_MARGIN, NO_EFFECT, PERFECT_FIT},
};

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
        let mut norm = difference(&nearest, &point).norm();
        // Gauss and Newton: the effects are linear up to the square of half a place.
        for _ in 0..BOX_PASSES {
            let effects = self.effects(&nearest, &point);
            let target = &effects * &parts - difference(&nearest, &point);
            let next = bounded_least_squares(&effects, &target, parts.clone());
            let moved = self.shifted(models, &next);
            let moved_norm = difference(&moved, &point).norm();
            if moved_norm >= norm {
                break;
            }
            (nearest, parts, norm) = (moved, next, moved_norm);
            if norm < PERFECT_FIT {
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

    /// The change of the difference at `point` by half a place of each value: one column for each.
    pub(in crate::diagnosis) fn effects(&self, models: &ModelPair, point: &EvaluationPoint) -> DMatrix<f64> {
        let before = difference(models, point);
        let columns: Vec<DVector<f64>> = self
            .values
            .iter()
            .map(|value| {
                let mut shifted = models.clone();
                value.shift(&mut shifted, value.half_place);
                difference(&shifted, point) - &before
            })
            .collect();
        DMatrix::from_columns(&columns)
    }
}

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

/// The `x` with `|x_i| <= 1` at which `|A x - b|` is smallest, by Newton's method projected onto the bounds.
///
/// Source: Bertsekas, *Projected Newton methods for optimization problems with simple constraints* (1982): values at a
/// bound that the gradient pushes outwards are held, the others take a Newton step, which is cut off at the bounds.
fn bounded_least_squares(a: &DMatrix<f64>, b: &DVector<f64>, mut x: DVector<f64>) -> DVector<f64> {
    // A value that is rounded from exactly the middle of two is off by half a place, and the sum of two such values by
    // twice that: without the margin, rounding of the last bit would decide.
    let most = 1.0 + DIGITS_MARGIN;
    let clamp = |x: DVector<f64>| x.map(|value| value.clamp(-most, most));
    let gram = a.tr_mul(a);
    let scale = gram.diagonal().max();
    let mut residual = a * &x - b;
    for _ in 0..BOX_STEPS {
        let gradient = a.tr_mul(&residual);
        let is_held = |at: usize| x[at].abs() >= most && x[at] * gradient[at] < 0.0;
        let free: Vec<usize> = (0..x.len()).filter(|&at| !is_held(at)).collect();
        let mut equations = gram.select_rows(&free).select_columns(&free);
        // Values with one effect make the equations singular. Relative to each value, since half places differ by
        // orders of magnitude.
        for at in 0..free.len() {
            equations[(at, at)] += BOX_DAMPING * equations[(at, at)] + NO_EFFECT * scale;
        }
        let Some(factors) = equations.cholesky() else { break };
        let step = factors.solve(&gradient.select_rows(&free));
        let moved = |part: f64| {
            let mut moved = x.clone();
            free.iter().zip(step.iter()).for_each(|(&at, by)| moved[at] -= part * by);
            clamp(moved)
        };
        let halves = std::iter::successors(Some(1.0), |part| Some(0.5 * part)).take(BOX_STEPS);
        let better = halves.map(moved).map(|x| (a * &x - b, x)).find(|(r, _)| r.norm() < residual.norm());
        let Some((next_residual, next)) = better else { break };
        (residual, x) = (next_residual, next);
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_stop_at_their_bounds() {
        let a = DMatrix::from_row_slice(2, 3, &[1.0, 0.0, 1.0, 0.0, 1.0, 1.0]);
        // Within: exact.
        let b = DVector::from_vec(vec![0.3, 0.4]);
        let x = bounded_least_squares(&a, &b, DVector::zeros(3));
        assert!((&a * &x - &b).norm() < 1e-9 && x.amax() <= 1.0 + DIGITS_MARGIN, "{x}");
        // Beyond: the nearest, at the bounds.
        let x = bounded_least_squares(&a, &DVector::from_vec(vec![3.0, 0.0]), DVector::zeros(3));
        // By hand: with x1 = 1 the rest is (x3 - 2)^2 + (x2 + x3)^2, smallest at x3 = 1 and x2 = -1.
        let expected = DVector::from_vec(vec![1.0, -1.0, 1.0]) * (1.0 + DIGITS_MARGIN);
        assert!((&x - &expected).amax() < 1e-6, "{x}");
    }
}
