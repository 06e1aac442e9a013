//! The models nearest to each other within the digits of their files.

use congruent_description::{ChainQ, Tolerance};
use congruent_kinematics::least_squares::BoundedLeastSquares;
use nalgebra::{DMatrix, DVector};

use super::{typed_value::TypedValue, written_digits::WrittenDigits};
use crate::diagnosis::{
    fit::evaluation_point::EvaluationPoint,
    hypothesis::ModelPair,
    thresholds::{BOX_DAMPING, BOX_PASSES, DIGITS_MARGIN, ENOUGH, FIRST_ORDER_ERRORS, OUT_OF_REACH},
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
            let linear = BoundedLeastSquares { effects: &effects, rest: &rest, from: &parts, most: MOST };
            let next = linear.nearest(damping * scale);
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
