//! Least squares by Levenberg-Marquardt, its covariance, and the noise estimated from the residuals.

use std::f64::consts::TAU;

use congruent_kinematics::least_squares::{BalancedCholesky, Damping, damped_step};
use nalgebra::DMatrix;

use super::{
    model::ParameterUnit,
    problem::{CalibrationEquations, Measurement, Noise, PoseResidual, Problem, Weighting},
};

/// Most iterations: near the solution each gains several digits, so this is far more than needed.
pub(super) const MOST_ITERATIONS: usize = 200;
/// A step below this, in rad and m, ends the iteration. Kind: solver stop, a hundredth of the rounding of
/// an angle.
const STEP: f64 = 1e-15;
/// Below this a step that has stopped shrinking is rounding. Kind: solver stop.
const ROUNDING_STEP: f64 = 1e-9;
/// How much the cost may rise by rounding alone, relative. Kind: rounding of some thousand terms.
const COST_ROUNDING: f64 = 1e-12;
/// Damping of the first step, relative to the diagonal of the information.
const FIRST_DAMPING: f64 = 1e-6;
/// Damping beyond which no step can lower the cost.
const MOST_DAMPING: f64 = 1e12;
/// Alternations of estimating the noise and the corrections; three suffice.
const NOISE_ROUNDS: usize = 8;

/// An estimate of the corrections, with its uncertainty and residuals.
#[derive(Debug, Clone, PartialEq)]
pub struct CalibrationFit {
    /// One entry for each correction of the chain, rad or m; that of its start for those that were not estimated.
    pub corrections: Vec<f64>,
    /// Standard deviations of the same, from the noise; 0 for those that were not estimated, not a number
    /// if the noise is not known and there is no redundancy to estimate it from.
    pub standard_deviations: Vec<f64>,
    /// Covariance of the estimated corrections, in their order; rad and m.
    pub covariance: DMatrix<f64>,
    /// Residual of each measurement.
    pub residuals: Vec<PoseResidual>,
    /// The noise that weighted the residuals.
    pub noise: Noise,
    /// Whether the last step was below rounding; otherwise the best that was found.
    pub converged: bool,
    /// Number of steps of the iteration.
    pub iterations: usize,
}

/// Least squares over the corrections `kept`, all rows alike, with a known noise.
///
/// # Panics
/// If a measurement's `q` has another length than the chain has joints.
pub fn fit(problem: &Problem<'_>, kept: &[usize], noise: Noise) -> CalibrationFit {
    let start = problem.chain.start().to_vec();
    let weighting = Weighting { noise: noise.floored(), rows: &[] };
    weighted_fit(problem, kept, start, &weighting, MOST_ITERATIONS)
}

/// Least squares with the noise estimated from the residuals, of positions and of orientations separately.
///
/// Source: Koch, *Parameter Estimation and Hypothesis Testing in Linear Models* (1999), section 3.6:
/// variance components, each block's squares over its own redundancy.
///
/// # Panics
/// As [`fit`].
pub fn fit_with_estimated_noise(problem: &Problem<'_>, kept: &[usize]) -> CalibrationFit {
    // Any ratio starts the iteration; this one makes an angle of 1 rad count like a distance of one reach.
    let mut noise = Noise { position_m: 1.0, orientation_rad: 1.0 / problem.reach_m() };
    let mut best = fit(problem, kept, noise);
    // For all rounds together: rows that no correction explains would take all iterations in each of them.
    let mut iterations_left = MOST_ITERATIONS - best.iterations;
    for _ in 0..NOISE_ROUNDS {
        // Noise and corrections depend on each other (the weights are 1 / noise^2), so they are estimated in
        // turn.
        noise = estimated_noise(problem, kept, &best).floored();
        let start = best.corrections.clone();
        // At least one, so that the standard deviations are those of this noise.
        let most = iterations_left.max(1);
        best = weighted_fit(problem, kept, start, &Weighting { noise, rows: &[] }, most);
        iterations_left = iterations_left.saturating_sub(best.iterations);
    }
    if !best.converged {
        best.iterations = MOST_ITERATIONS - iterations_left;
    }
    best.with_redundancy(problem.redundancy(kept))
}

impl CalibrationFit {
    /// Without redundancy the residuals vanish whatever the noise was, so the deviations are not known.
    #[must_use]
    pub(super) fn with_redundancy(mut self, redundancy: usize) -> Self {
        if redundancy == 0 {
            // Zero would claim a perfect estimate. NaN becomes null in the report.
            self.covariance.fill(f64::NAN);
            let estimated = self.standard_deviations.iter_mut().filter(|deviation| **deviation != 0.0);
            estimated.for_each(|deviation| *deviation = f64::NAN);
        }
        self
    }
}

/// The noise of positions and orientations, estimated from the residuals of a fit.
fn estimated_noise(problem: &Problem<'_>, kept: &[usize], fit: &CalibrationFit) -> Noise {
    let weighting = Weighting { noise: fit.noise, rows: &[] };
    let equations = problem.normal_equations(&fit.corrections, kept, &weighting);
    // The share of the corrections that positions determine; orientations determine the rest.
    let by_position =
        inverse(&equations.information).map_or(0.0, |inverse| (inverse * &equations.by_position).trace());
    let count = |of: fn(&Measurement) -> usize| -> usize { problem.measurements.iter().map(of).sum() };
    let positions: f64 = fit.residuals.iter().map(|each| each.position_m.norm_squared()).sum();
    let rotations: f64 = fit.residuals.iter().map(|each| each.orientation_rad.norm_squared()).sum();
    // Traces add up to the number of corrections: trace(N^-1 N_position) + trace(N^-1 N_orientation) = trace(I).
    let by_orientation = as_f64(kept.len()) - by_position;
    Noise {
        position_m: deviation(positions, count(Measurement::position_count), by_position),
        orientation_rad: deviation(rotations, count(Measurement::orientation_count), by_orientation),
    }
}

/// Root of a sum of squares over its redundancy; for a block without redundancy its root mean
/// square, which is then too small, and no better value exists.
fn deviation(squares: f64, count: usize, determined: f64) -> f64 {
    if count == 0 {
        return 0.0;
    }
    let redundancy = as_f64(count) - determined;
    // The redundancy of a block is a trace, not an integer: below one half it is zero within rounding.
    (squares / if redundancy >= 0.5 { redundancy } else { as_f64(count) }).sqrt()
}

#[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 components")]
pub(super) fn as_f64(count: usize) -> f64 {
    count as f64
}

/// Least squares from a start, each row with its weight.
pub(super) fn weighted_fit(
    problem: &Problem<'_>,
    kept: &[usize],
    start: Vec<f64>,
    weighting: &Weighting<'_>,
    most_iterations: usize,
) -> CalibrationFit {
    let mut p = start;
    let mut equations = problem.normal_equations(&p, kept, weighting);
    let (mut damping, mut last_step, mut converged, mut iterations) =
        (FIRST_DAMPING, f64::INFINITY, kept.is_empty(), 0);
    while !converged && iterations < most_iterations && damping < MOST_DAMPING {
        iterations += 1;
        let damped = Damping { relative: damping, absolute: 0.0 };
        // Not positive definite at this damping: more of it makes the matrix diagonally dominant.
        let Some(step) = damped_step(&equations.information, &equations.gradient, damped) else {
            damping *= 10.0;
            continue;
        };
        let mut moved = p.clone();
        kept.iter().zip(step.iter()).for_each(|(&at, step)| moved[at] += step);
        let size = step.amax();
        let cost = problem.cost(&moved, weighting);
        // Near the solution the cost changes by rounding alone; without the margin good last steps would be
        // refused.
        if cost <= equations.cost * (1.0 + COST_ROUNDING) {
            p = moved;
            equations = problem.normal_equations(&p, kept, weighting);
            // Far below the diagonal damping has no effect: zero gives the quadratic convergence of Gauss-Newton.
            damping = if damping < 1e-14 { 0.0 } else { damping / 100.0 };
            // A step that no longer shrinks below 1e-9 is the rounding of the residuals, not progress.
            converged = size <= STEP || (size < ROUNDING_STEP && size >= last_step);
            last_step = size;
        } else if size < ROUNDING_STEP {
            // The cost cannot resolve such a step: the solution is the current value.
            converged = true;
        } else {
            // Damping may be zero here, which no factor increases.
            damping = (damping * 10.0).max(FIRST_DAMPING);
        }
    }
    // A gross error may move an angle through whole turns; these have no effect on the poses.
    for &at in kept {
        if problem.chain.parameters()[at].unit() == ParameterUnit::Angle {
            p[at] -= TAU * (p[at] / TAU).round();
        }
    }
    let covariance = covariance(&equations, kept.len());
    let mut standard_deviations = vec![0.0; p.len()];
    for (row, &at) in kept.iter().enumerate() {
        standard_deviations[at] = covariance[(row, row)].sqrt();
    }
    let (residuals, noise) = (problem.residuals(&p), weighting.noise);
    CalibrationFit {
        corrections: p,
        standard_deviations,
        covariance,
        residuals,
        noise,
        converged,
        iterations,
    }
}

/// Covariance of the corrections that are estimated, `count` of them: inverse of their information.
fn covariance(equations: &CalibrationEquations, count: usize) -> DMatrix<f64> {
    // A singular matrix cannot arise from corrections that were identified, except at a gross misfit: then
    // nothing is known.
    inverse(&equations.information).unwrap_or_else(|| DMatrix::from_element(count, count, f64::NAN))
}

/// Inverse of a positive definite matrix.
fn inverse(information: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    Some(BalancedCholesky::new(information.clone())?.inverse())
}
