//! Least squares on screws and tip: the free numbers of a hypothesis, by Levenberg and Marquardt.

use congruent_kinematics::least_squares::{Damping, NormalEquations};
use nalgebra::DVector;

use super::{
    candidate::{Candidate, ChainWalk, ModelParameter},
    evaluation_point::EvaluationPoint,
    reference_model::ChainState,
};

/// A loop bound, not a quality: fits that reach zero take some six steps.
const MOST_STEPS: usize = 60;
/// A step that gains less than this share of the norm has met the bottom of another valley.
const LEAST_GAIN: f64 = 1e-3;
/// Norm, without unit, at which rounding is all that is left of some fifty numbers.
const ROUNDING: f64 = 3e-16;

/// A candidate with its free numbers fitted.
#[derive(Debug, Clone)]
pub(super) struct FittedCandidate {
    pub(super) candidate: Candidate,
    /// Root of the sum of squares that is left, without unit.
    pub(super) norm: f64,
}

/// What is fitted to: the reference's screws and tip, seen from a evaluation_point.
#[derive(Debug, Clone, Copy)]
pub(super) struct FitTarget<'a> {
    pub(super) evaluation_point: &'a EvaluationPoint,
    pub(super) snapshot: &'a ChainState,
}

impl FitTarget<'_> {
    /// How far a candidate is from the target as it stands.
    pub(super) fn norm(&self, candidate: &Candidate) -> f64 {
        norm(&self.difference(candidate, &candidate.walk(&self.evaluation_point.q)))
    }

    fn difference(&self, candidate: &Candidate, walk: &ChainWalk) -> Vec<f64> {
        self.evaluation_point.difference(candidate, walk, self.snapshot)
    }

    /// Fits `free` from where the candidate stands.
    ///
    /// Source: Marquardt (1963), the damping scaled by the diagonal, which mixes rad and m safely.
    pub(super) fn refit(&self, candidate: &Candidate, free: &[ModelParameter]) -> FittedCandidate {
        let mut walk = candidate.walk(&self.evaluation_point.q);
        let mut difference = self.difference(candidate, &walk);
        let mut best = FittedCandidate { candidate: candidate.clone(), norm: norm(&difference) };
        let mut damping = 1e-6;
        for _ in 0..MOST_STEPS {
            if best.norm < ROUNDING || free.is_empty() {
                break;
            }
            let Some(step) = self.step(&best.candidate, (&walk, &difference), free, damping) else { break };
            let mut moved = best.candidate.clone();
            for (&parameter, &by) in free.iter().zip(step.iter()) {
                moved.shift(parameter, by);
            }
            let moved_walk = moved.walk(&self.evaluation_point.q);
            let moved_difference = self.difference(&moved, &moved_walk);
            let left = norm(&moved_difference);
            if left < best.norm {
                let gain = 1.0 - left / best.norm;
                best = FittedCandidate { candidate: moved, norm: left };
                (walk, difference) = (moved_walk, moved_difference);
                damping = (damping * 0.1_f64).max(1e-12);
                if gain < LEAST_GAIN {
                    break;
                }
            } else {
                damping *= 100.0;
                if damping > 1e4 {
                    break;
                }
            }
        }
        best
    }

    fn step(
        &self,
        candidate: &Candidate,
        (walk, difference): (&ChainWalk, &[f64]),
        free: &[ModelParameter],
        damping: f64,
    ) -> Option<DVector<f64>> {
        let column = |&parameter: &ModelParameter| {
            let influence = candidate.influence(parameter, &self.evaluation_point.q, walk)?;
            Some(self.evaluation_point.derivative(candidate, walk, &influence))
        };
        let columns: Vec<Vec<f64>> = free.iter().map(column).collect::<Option<_>>()?;
        // The absolute part keeps a number that changes nothing where it is.
        NormalEquations::of_columns(&columns, difference)
            .damped_step(Damping { relative: damping, absolute: 1e-15 })
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(numbers: &[f64]) -> f64 {
    dot(numbers, numbers).sqrt()
}
