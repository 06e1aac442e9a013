//! Where to measure next: the configurations that would be most informative about the corrections.

use congruent_description::ChainQ;
use congruent_kinematics::Pose;
use nalgebra::{Cholesky, DMatrix, Dyn};

use super::{
    model::ParameterUnit,
    problem::{Linearisation, Measurement, Noise, Problem, Weighting},
};

/// Standard deviation of a correction before anything is measured, as a share of the reach. It keeps the
/// gain finite for corrections that have not been identified yet.
const PRIOR_SHARE_OF_REACH: f64 = 0.01;

/// A candidate is alike to one that was picked before if no joint differs by more than this
/// share of the range that the candidates cover.
const ALIKE_SHARE: f64 = 0.2;

/// A configuration worth measuring.
#[derive(Debug, Clone, PartialEq)]
pub struct Suggestion {
    /// Index among the candidates.
    pub candidate: usize,
    /// Information that it adds to the measurements and to the suggestions before it, in bits: each bit
    /// halves the volume of the uncertainty.
    pub gain_bits: f64,
}

/// Picks `count` of the candidate configurations, one after another, each with the largest gain of
/// information (D-optimality) when added to all before it, and unlike each before it.
///
/// The next measurements are taken to be of the same kind as the first, with the same noise.
///
/// Source: Fedorov, *Theory of Optimal Experiments* (1972), chapter 3, with a normal prior.
///
/// # Panics
/// If a candidate has another length than the chain has joints.
pub fn most_informative(
    problem: &Problem<'_>,
    corrections: &[f64],
    noise: &Noise,
    candidates: &[ChainQ],
    count: usize,
) -> Vec<Suggestion> {
    let Some(like) = problem.measurements.first() else { return Vec::new() };
    let noise = noise.floored();
    let all: Vec<usize> = (0..corrections.len()).collect();
    let mut information =
        // Without a prior the determinant is zero as long as one correction is not identified, and every gain
        // would be infinite.
        prior(problem) + problem.normal_equations(corrections, &all, &Weighting { noise, rows: &[] }).information;
    let mut linearisation = Linearisation::new(problem.chain, corrections, &all);
    // Linearised at the present estimate once: the information of a candidate does not depend on the others.
    let added: Vec<DMatrix<f64>> = candidates
        .iter()
        .map(|q| {
            let measurement = like_at(like, q, problem.chain.base_from_tip(q, corrections));
            linearisation.equations([(&measurement, 1.0)].into_iter(), &noise).information
        })
        .collect();
    let ranges = ranges(candidates);
    let mut suggestions: Vec<Suggestion> = Vec::with_capacity(count.min(candidates.len()));
    for _ in 0..count.min(candidates.len()) {
        let Some(before) = information.clone().cholesky().map(|factor| log_volume(&factor)) else { break };
        let gain = |candidate: usize| {
            let after = (&information + &added[candidate]).cholesky()?;
            // Half of log2 det after minus before: the volume of the uncertainty is det^(-1/2).
            let gain_bits = (log_volume(&after) - before) / std::f64::consts::LN_2;
            Some(Suggestion { candidate, gain_bits })
        };
        // The most informative configuration repeated may still have the largest gain; a repetition cannot show
        // whether the model holds elsewhere.
        let is_new = |&candidate: &usize| {
            suggestions
                .iter()
                .all(|each| !are_alike(&ranges, &candidates[candidate], &candidates[each.candidate]))
        };
        let best = (0..candidates.len()).filter(is_new).filter_map(gain).fold(
            None,
            |best: Option<Suggestion>, next| {
                // Strictly larger, so that of equal gains the first candidate is taken and the result does not
                // depend on the order of evaluation.
                if best.as_ref().is_none_or(|best| next.gain_bits > best.gain_bits) {
                    Some(next)
                } else {
                    best
                }
            },
        );
        let Some(best) = best else { break };
        information += &added[best.candidate];
        suggestions.push(best);
    }
    suggestions
}

/// Range of the candidates, for each joint.
fn ranges(candidates: &[ChainQ]) -> Vec<f64> {
    let joints = candidates.first().map_or(0, |q| q.len());
    let of = |joint: usize| {
        let values = || candidates.iter().map(|q| q[joint]);
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    };
    (0..joints).map(of).collect()
}

fn are_alike(ranges: &[f64], a: &[f64], b: &[f64]) -> bool {
    ranges.iter().zip(a).zip(b).all(|((range, a), b)| (a - b).abs() <= ALIKE_SHARE * range)
}

/// The same kind of measurement at another configuration, with the expected pose.
fn like_at(like: &Measurement, q: &ChainQ, expected: Pose) -> Measurement {
    let mut tip_in_base_m = like.tip_in_base_m;
    for (coordinate, expected) in tip_in_base_m.iter_mut().zip(&expected.translation) {
        *coordinate = coordinate.and(Some(*expected));
    }
    Measurement {
        q: q.clone(),
        tip_in_base_m,
        base_from_tip: like.base_from_tip.and(Some(expected.rotation)),
        camera_from_target: like.camera_from_target,
    }
}

fn prior(problem: &Problem<'_>) -> DMatrix<f64> {
    let reach_m = problem.reach_m();
    let parameters = problem.chain.parameters();
    DMatrix::from_fn(parameters.len(), parameters.len(), |row, column| {
        let deviation = match parameters[row].unit() {
            ParameterUnit::Angle => PRIOR_SHARE_OF_REACH,
            ParameterUnit::Length => PRIOR_SHARE_OF_REACH * reach_m,
        };
        if row == column { 1.0 / (deviation * deviation) } else { 0.0 }
    })
}

/// Half the logarithm of the determinant.
fn log_volume(factor: &Cholesky<f64, Dyn>) -> f64 {
    // det A = (product of the factor's diagonal)^2, so this is half of log det.
    factor.l_dirty().diagonal().iter().map(|entry| libm::log(*entry)).sum()
}
