//! Least squares on screws and tip for the free parameters of a hypothesis, by Levenberg and Marquardt.

use congruent_kinematics::least_squares::{Damping, NormalEquations};

use crate::diagnosis::{
    candidate::{CandidateModel, ChainWalk, ModelParameter},
    fit::evaluation_point::EvaluationPoint,
    reference_model::ChainState,
    thresholds::{DAMPING, MAX_STEPS, MIN_GAIN, NO_EFFECT, PERFECT_FIT},
};

/// A candidate with its free parameters fitted.
#[derive(Debug, Clone)]
pub(in crate::diagnosis) struct FittedCandidate {
    pub(in crate::diagnosis) candidate: CandidateModel,
    /// Norm of the remaining difference, without unit.
    pub(in crate::diagnosis) norm: f64,
}

/// The target of a fit: screws and tip of the reference model at the evaluation point.
#[derive(Debug, Clone, Copy)]
pub(in crate::diagnosis) struct FitTarget<'a> {
    pub(in crate::diagnosis) evaluation_point: &'a EvaluationPoint,
    pub(in crate::diagnosis) state: &'a ChainState,
}

impl FitTarget<'_> {
    /// Norm of the difference of a candidate from the target.
    pub(in crate::diagnosis) fn norm(&self, candidate: &CandidateModel) -> f64 {
        norm(&self.difference(candidate, &candidate.walk(&self.evaluation_point.q)))
    }

    fn difference(&self, candidate: &CandidateModel, walk: &ChainWalk) -> Vec<f64> {
        self.evaluation_point.difference(candidate, walk, self.state)
    }

    /// Fits the parameters `free`, starting at their present values.
    ///
    /// Source: Marquardt (1963), the damping scaled by the diagonal, which mixes rad and m safely.
    pub(in crate::diagnosis) fn refit(
        &self,
        candidate: &CandidateModel,
        free: &[ModelParameter],
    ) -> FittedCandidate {
        let mut walk = candidate.walk(&self.evaluation_point.q);
        let mut difference = self.difference(candidate, &walk);
        let mut best = FittedCandidate { candidate: candidate.clone(), norm: norm(&difference) };
        let mut damping = DAMPING.first;
        for _ in 0..MAX_STEPS {
            if best.norm < PERFECT_FIT || free.is_empty() {
                break;
            }
            let Some(columns) = self.columns(&best.candidate, &walk, free) else { break };
            // The absolute part keeps a parameter without effect at its value.
            let damped = Damping { relative: damping, absolute: NO_EFFECT };
            let equations = NormalEquations::from_columns(&columns, &difference);
            let Some(step) = equations.damped_step(damped) else { break };
            let mut moved = best.candidate.clone();
            for (&parameter, &by) in free.iter().zip(step.iter()) {
                moved.shift(parameter, by);
            }
            let moved_walk = moved.walk(&self.evaluation_point.q);
            let moved_difference = self.difference(&moved, &moved_walk);
            let moved_norm = norm(&moved_difference);
            if moved_norm < best.norm {
                let gain = 1.0 - moved_norm / best.norm;
                best = FittedCandidate { candidate: moved, norm: moved_norm };
                (walk, difference) = (moved_walk, moved_difference);
                damping = (damping * DAMPING.after_success).max(DAMPING.least);
                // Near a minimum other than zero each step gains less than the last. Such a hypothesis is wrong,
                // and hundreds of them are fitted, so the digits of its norm are not worth further steps.
                if gain < MIN_GAIN {
                    break;
                }
            } else {
                // Faster up than down: a rejected step costs an evaluation and gives nothing.
                damping *= DAMPING.after_failure;
                if damping > DAMPING.most {
                    break;
                }
            }
        }
        best
    }

    /// Derivatives of the difference by each of these parameters.
    fn columns(
        &self,
        candidate: &CandidateModel,
        walk: &ChainWalk,
        free: &[ModelParameter],
    ) -> Option<Vec<Vec<f64>>> {
        let column = |&parameter: &ModelParameter| {
            let effect = candidate.parameter_effect(parameter, &self.evaluation_point.q, walk)?;
            Some(self.evaluation_point.derivative(candidate, walk, &effect))
        };
        free.iter().map(column).collect()
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(numbers: &[f64]) -> f64 {
    dot(numbers, numbers).sqrt()
}
