//! Estimates that are robust to gross errors: least squares reweighted by a robust loss, and its outliers.

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    estimate::{CalibrationFit, MOST_ITERATIONS, as_f64, weighted_fit},
    problem::{Measurement, Noise, PoseResidual, Problem, Weighting, median_norm, outlying_norm},
};

/// Most reweightings. Kind: bound; a dozen is usual.
const MOST_ROUNDS: usize = 100;
/// Most iterations of all reweightings together, and of all steps to the half of the rows that agrees. Kind: bound; two hundred is
/// much for rows of the robot, and rows that do not belong to it take whatever there is.
const MOST_ITERATIONS_OF_ROUNDS: usize = 400;
/// Smallest ratio of the noise of one kind of component to that of the other, an angle times the reach.
/// Kind: conditioning; its square stays well above rounding.
const LEAST_RATIO: f64 = 1e-4;
/// Reweighting ends when no correction moves by more, in rad or m. Kind: solver stop.
const MOVE: f64 = 1e-12;

/// A robust loss: the weight of a row by its distance from the model, in robust standard deviations.
///
/// The constants k give 95 % of the efficiency of least squares on normal noise.
/// Source: Holland & Welsch, *Robust regression using iteratively reweighted least-squares* (1977).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Loss {
    /// Quadratic near, linear far: every row keeps some influence (k = 1.345).
    Huber,
    /// Logarithmic: the influence of a row decreases with its distance (k = 2.385).
    Cauchy,
    /// Bounded: a far row has no influence (k = 4.685).
    Tukey,
}

impl fmt::Display for Loss {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(formatter)
    }
}

impl Loss {
    /// Weight of a row at a distance.
    ///
    /// # Examples
    /// ```
    /// use congruent_calibration::estimation::Loss;
    /// assert_eq!(Loss::Huber.weight(1.0), 1.0);
    /// assert_eq!(Loss::Huber.weight(2.69), 0.5);
    /// assert_eq!(Loss::Cauchy.weight(2.385), 0.5);
    /// assert_eq!(Loss::Tukey.weight(5.0), 0.0);
    /// ```
    pub fn weight(self, distance: f64) -> f64 {
        let ratio = distance / self.k();
        match self {
            Self::Huber => (1.0 / ratio).min(1.0),
            Self::Cauchy => 1.0 / (1.0 + ratio.powi(2)),
            Self::Tukey => (1.0 - ratio.powi(2)).max(0.0).powi(2),
        }
    }

    /// Cost of a row at a distance: its square if that is small.
    ///
    /// # Examples
    /// ```
    /// use congruent_calibration::estimation::Loss;
    /// assert_eq!(Loss::Huber.cost(1.0), 1.0);
    /// assert_eq!(Loss::Huber.cost(2.69), 3.0 * 1.345 * 1.345);
    /// assert_eq!(Loss::Tukey.cost(5.0), Loss::Tukey.cost(50.0));
    /// ```
    pub fn cost(self, distance: f64) -> f64 {
        let k = self.k();
        let ratio = distance / k;
        let in_k = match self {
            Self::Huber if ratio <= 1.0 => ratio.powi(2),
            Self::Huber => 2.0 * ratio - 1.0,
            Self::Cauchy => libm::log1p(ratio.powi(2)),
            Self::Tukey => (1.0 - (1.0 - ratio.powi(2)).max(0.0).powi(3)) / 3.0,
        };
        in_k * k * k
    }

    /// The tuning constant: the distance at which the loss departs from the square.
    fn k(self) -> f64 {
        match self {
            Self::Huber => 1.345,
            Self::Cauchy => 2.385,
            Self::Tukey => 4.685,
        }
    }
}

/// An estimate with a robust loss.
#[derive(Debug, Clone, PartialEq)]
pub struct RobustFit {
    /// The loss of a row by its distance.
    pub loss: Loss,
    /// The estimate; its noise is that of the inliers.
    pub fit: CalibrationFit,
    /// Weight of each row, in 0 to 1.
    pub weights: Vec<f64>,
    /// The noise that scales the weights: that of the half of the rows which agree best.
    pub scale: Noise,
    /// Rows whose distance normal noise exceeds once in 10,000.
    pub outliers: Vec<usize>,
}

/// Estimates the corrections `kept` with a robust loss; the noise comes from the median row unless
/// it is known.
///
/// It starts at the half of the rows that agree best, searched for from least squares and from the chain's start, takes
/// the scale there, holds it, and reweights (an MM estimate) from there, or from least squares if that has the smaller cost, since from plain least squares a bounded loss may
/// converge to the wrong rows.
///
/// Source: Yohai, *High breakdown-point and high efficiency robust estimates for regression* (1987);
/// the factor for a small sample is that of Rousseeuw & Leroy, *Robust Regression and Outlier
/// Detection* (1987), section 5.1.
///
/// # Panics
/// As [`fit`](crate::estimation::fit).
pub fn fit_robustly(
    problem: &Problem<'_>,
    kept: &[usize],
    loss: Loss,
    start: &CalibrationFit,
    known_noise: Option<Noise>,
) -> RobustFit {
    let mut fit = start_of_agreement(problem, kept, start, known_noise);
    let noise_of = |fit: &CalibrationFit, factor: f64| {
        known_noise.unwrap_or_else(|| median_noise(problem, &fit.residuals, factor)).floored()
    };
    let components = as_f64(problem.component_count());
    // At least 1: without redundancy the factors below would divide by zero.
    let redundancy = (components - as_f64(kept.len())).max(1.0);
    let scale = noise_of(&fit, 1.0 + 5.0 / redundancy);
    // The half may be at configurations that hardly identify a correction, far off at all others: then all rows agree better.
    if cost(problem, loss, start, &scale) < cost(problem, loss, &fit, &scale) {
        fit = start.clone();
    }
    let mut weights = vec![1.0; problem.measurements.len()];
    let mut settled = false;
    let mut iterations_left = MOST_ITERATIONS_OF_ROUNDS;
    for _ in 0..MOST_ROUNDS {
        let rows = problem.measurements.iter().zip(&fit.residuals);
        for (weight, (measurement, residual)) in weights.iter_mut().zip(rows) {
            // The scale is held during the reweighting: if it followed the residuals, a bounded loss could shrink
            // it to nothing.
            *weight = loss.weight(distance(measurement, residual, &scale));
        }
        let before = fit.corrections.clone();
        let weighting = Weighting { noise: scale, rows: &weights };
        fit = weighted_fit(problem, kept, before.clone(), &weighting, MOST_ITERATIONS);
        let moved = before.iter().zip(&fit.corrections).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        if moved <= MOVE {
            settled = true;
            break;
        }
        iterations_left = iterations_left.saturating_sub(fit.iterations);
        if iterations_left == 0 {
            break;
        }
    }
    // The start had selected the nearest rows; now nearly all of them determine the scale.
    let noise = noise_of(&fit, (components / redundancy).sqrt());
    let weighting = Weighting { noise, rows: &weights };
    fit = weighted_fit(problem, kept, fit.corrections, &weighting, MOST_ITERATIONS);
    fit.converged &= settled;
    if !fit.converged {
        fit.iterations += MOST_ITERATIONS_OF_ROUNDS - iterations_left;
    }
    let outlies = |&row: &usize| {
        let (measurement, residual) = (&problem.measurements[row], &fit.residuals[row]);
        residual.whitened_squared(&fit.noise).sqrt() > outlying_norm(measurement.component_count())
    };
    let outliers = (0..weights.len()).filter(outlies).collect();
    if known_noise.is_none() {
        fit = fit.with_redundancy(problem.redundancy(kept));
    }
    RobustFit { loss, fit, weights, scale, outliers }
}

/// Norm of a row in units of the noise, scaled so that half of normal rows are within 0.6745, as of
/// one normal component.
pub(super) fn distance(measurement: &Measurement, residual: &PoseResidual, noise: &Noise) -> f64 {
    residual.whitened_squared(noise).sqrt() * median_norm(1) / median_norm(measurement.component_count())
}

/// Cost of all rows by a robust loss.
fn cost(problem: &Problem<'_>, loss: Loss, fit: &CalibrationFit, scale: &Noise) -> f64 {
    let rows = problem.measurements.iter().zip(&fit.residuals);
    rows.map(|(measurement, residual)| loss.cost(distance(measurement, residual, scale))).sum()
}

/// Of the halves found from least squares and from the chain's start the one that agrees better: a row with an error
/// beyond the reach moves least squares so far that no half found from it is right.
fn start_of_agreement(
    problem: &Problem<'_>,
    kept: &[usize],
    plain: &CalibrationFit,
    known_noise: Option<Noise>,
) -> CalibrationFit {
    let noise_of = |residuals: &[PoseResidual]| {
        known_noise.unwrap_or_else(|| comparable_noise(problem, residuals)).floored()
    };
    let start = problem.chain.start().to_vec();
    // The nominal model is close to the truth for most arms, and an outlier has moved neither it nor aligned frames.
    let at_start = problem.residuals(&start);
    let found = [(plain.corrections.clone(), &plain.residuals), (start, &at_start)].map(
        |(corrections, residuals)| concentrated(problem, kept, corrections, residuals, noise_of(residuals)),
    );
    let size = |fit: &CalibrationFit| {
        let Noise { position_m, orientation_rad } = comparable_noise(problem, &fit.residuals).floored();
        let count = |of: fn(&Measurement) -> usize| as_f64(problem.measurements.iter().map(of).sum());
        // The logarithm of the likelihood of normal noise at its maximum: n log sigma, for both kinds together.
        count(Measurement::position_count) * libm::log(position_m)
            + count(Measurement::orientation_count) * libm::log(orientation_rad)
    };
    let [from_plain, from_start] = found;
    // Of two that agree alike the one from the start, which moved less.
    if size(&from_start) <= size(&from_plain) { from_start } else { from_plain }
}

/// Noise of the median row, neither kind so small against the other that it alone would decide.
pub(super) fn comparable_noise(problem: &Problem<'_>, residuals: &[PoseResidual]) -> Noise {
    let Noise { position_m, orientation_rad } = median_noise(problem, residuals, 1.0);
    let reach_m = problem.reach_m();
    Noise {
        // Exact orientations beside noisy positions, as of a simulation, would have weights whose squares are
        // beyond the digits of a double.
        position_m: position_m.max(LEAST_RATIO * orientation_rad * reach_m),
        orientation_rad: orientation_rad.max(LEAST_RATIO * position_m / reach_m),
    }
}

/// Least squares over that half of the rows which it fits best, found by repeatedly leaving the worst half
/// out: up to nearly half of the rows may be wrong.
///
/// Source: Rousseeuw & Van Driessen, *Computing LTS regression for large data sets* (2006), the
/// concentration step.
pub(super) fn concentrated(
    problem: &Problem<'_>,
    kept: &[usize],
    start: Vec<f64>,
    residuals: &[PoseResidual],
    noise: Noise,
) -> CalibrationFit {
    let rows = problem.measurements.len();
    // Half, and as many more as the corrections need.
    let per_row = (problem.component_count() / rows.max(1)).max(1);
    let half = (rows + kept.len().div_ceil(per_row)).div_ceil(2).min(rows);
    let nearest_half = |residuals: &[PoseResidual]| {
        let distance = |row: &usize| distance(&problem.measurements[*row], &residuals[*row], &noise);
        let mut nearest: Vec<usize> = (0..rows).collect();
        nearest.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
        let mut chosen = vec![0.0; rows];
        nearest.iter().take(half).for_each(|&row| chosen[row] = 1.0);
        chosen
    };
    let fit_of = |start: Vec<f64>, chosen: &[f64]| {
        weighted_fit(problem, kept, start, &Weighting { noise, rows: chosen }, MOST_ITERATIONS)
    };
    let mut chosen = nearest_half(residuals);
    let mut fit = fit_of(start, &chosen);
    let mut iterations = fit.iterations;
    for _ in 0..MOST_ROUNDS {
        let next = nearest_half(&fit.residuals);
        // Each step lowers the sum of the chosen squares, so the choice cannot return to an earlier one: equal
        // means converged.
        if next == chosen || iterations >= MOST_ITERATIONS_OF_ROUNDS {
            break;
        }
        chosen = next;
        fit = fit_of(fit.corrections, &chosen);
        iterations += fit.iterations;
    }
    fit
}

/// Noise of positions and of orientations from the median row, times a factor for the degrees of freedom
/// that the fit has used.
fn median_noise(problem: &Problem<'_>, residuals: &[PoseResidual], factor: f64) -> Noise {
    let rows = || problem.measurements.iter().zip(residuals);
    let position = |(each, residual): (&Measurement, &PoseResidual)| {
        let count = each.position_count();
        (count > 0).then(|| residual.position_m.norm() / median_norm(count))
    };
    let orientation = |(each, residual): (&Measurement, &PoseResidual)| {
        let count = each.orientation_count();
        (count > 0).then(|| residual.orientation_rad.norm() / median_norm(count))
    };
    Noise {
        position_m: factor * median(rows().filter_map(position).collect()),
        orientation_rad: factor * median(rows().filter_map(orientation).collect()),
    }
}

/// The median, 0 of nothing; of an even number the upper of the two in the middle.
pub(super) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    // The upper one: the half that agrees must hold at least half of the rows.
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}
