//! Estimates that gross errors cannot bend: least squares reweighted by a robust loss, and the rows
//! that such an estimate leaves out.

use super::{
    estimate::{Fit, as_f64, weighted_fit},
    noise::{Noise, median_norm, outlying_norm},
    residuals::{Measurement, Problem, Residual, Weighting},
};

/// Most reweightings. Kind: bound; a dozen is usual.
const MOST_ROUNDS: usize = 100;
/// How small the noise of one kind of component is let be against that of the other, an angle times
/// the reach. Kind: conditioning; its square stays well above rounding.
const LEAST_RATIO: f64 = 1e-4;
/// Reweighting ends when no correction moves by more, in rad or m. Kind: solver stop.
const MOVE: f64 = 1e-12;

/// How much a row counts by its distance from the model, in robust standard deviations.
///
/// The constants give 95 % of the efficiency of least squares on normal noise.
/// Source: Holland & Welsch, *Robust regression using iteratively reweighted least-squares* (1977).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Loss {
    /// Quadratic near, linear far: every row keeps some pull. k = 1.345.
    Huber,
    /// Logarithmic: the pull of a row fades with its distance. k = 2.385.
    Cauchy,
    /// Bounded: a far row has no pull at all. k = 4.685.
    Tukey,
}

impl Loss {
    /// Weight of a row at a distance.
    ///
    /// # Examples
    /// ```
    /// use crate::estimation::Loss;
    /// assert_eq!(Loss::Huber.weight(1.0), 1.0);
    /// assert_eq!(Loss::Huber.weight(2.69), 0.5);
    /// assert_eq!(Loss::Cauchy.weight(2.385), 0.5);
    /// assert_eq!(Loss::Tukey.weight(5.0), 0.0);
    /// ```
    pub fn weight(self, distance: f64) -> f64 {
        let ratio = distance / self.bend();
        match self {
            Self::Huber => (1.0 / ratio).min(1.0),
            Self::Cauchy => 1.0 / (1.0 + ratio.powi(2)),
            Self::Tukey => (1.0 - ratio.powi(2)).max(0.0).powi(2),
        }
    }

    /// What a row costs at a distance: its square where that is small.
    ///
    /// # Examples
    /// ```
    /// use crate::estimation::Loss;
    /// assert_eq!(Loss::Huber.cost(1.0), 1.0);
    /// assert_eq!(Loss::Huber.cost(2.69), 3.0 * 1.345 * 1.345);
    /// assert_eq!(Loss::Tukey.cost(5.0), Loss::Tukey.cost(50.0));
    /// ```
    pub fn cost(self, distance: f64) -> f64 {
        let bend = self.bend();
        let ratio = distance / bend;
        let in_bends = match self {
            Self::Huber if ratio <= 1.0 => ratio.powi(2),
            Self::Huber => 2.0 * ratio - 1.0,
            Self::Cauchy => ratio.powi(2).ln_1p(),
            Self::Tukey => (1.0 - (1.0 - ratio.powi(2)).max(0.0).powi(3)) / 3.0,
        };
        in_bends * bend * bend
    }

    /// The distance at which the loss bends away from the square.
    fn bend(self) -> f64 {
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
    /// The estimate; its noise is that of the rows which fit.
    pub fit: Fit,
    /// Weight of each row, in 0 to 1.
    pub weights: Vec<f64>,
    /// The noise by which the weights were given: that of the half of the rows which agree best.
    pub scale: Noise,
    /// Rows that by chance would be as far off once in 10,000, if the noise were normal.
    pub outliers: Vec<usize>,
}

/// Estimates the corrections `kept` with a robust loss; the noise comes from the median row unless
/// it is known.
///
/// It starts at the half of the rows that agree best, searched for from least squares and from nominal, takes the scale there, holds it, and reweights
/// (an MM estimate), since from plain least squares a bounded loss may settle at the wrong rows.
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
    (start, known_noise): (&Fit, Option<Noise>),
) -> RobustFit {
    let mut fit = start_of_agreement(problem, kept, (start, known_noise));
    let found = |fit: &Fit, factor: f64| {
        known_noise.unwrap_or_else(|| median_noise(problem, &fit.residuals, factor)).floored()
    };
    let components = as_f64(problem.component_count());
    let redundancy = (components - as_f64(kept.len())).max(1.0);
    let scale = found(&fit, 1.0 + 5.0 / redundancy);
    let mut weights = vec![1.0; problem.measurements.len()];
    let mut settled = false;
    for _ in 0..MOST_ROUNDS {
        let rows = problem.measurements.iter().zip(&fit.residuals);
        for (weight, (measurement, residual)) in weights.iter_mut().zip(rows) {
            *weight = loss.weight(distance(measurement, residual, &scale));
        }
        let before = fit.corrections.clone();
        fit = weighted_fit(problem, kept, before.clone(), &Weighting { noise: scale, rows: &weights });
        let moved = before.iter().zip(&fit.corrections).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        if moved <= MOVE {
            settled = true;
            break;
        }
    }
    // The start had chosen its rows for being near; now nearly all of them have a say in the scale.
    let noise = found(&fit, (components / redundancy).sqrt());
    fit = weighted_fit(problem, kept, fit.corrections, &Weighting { noise, rows: &weights });
    fit.converged &= settled;
    let outlies = |&row: &usize| {
        let (measurement, residual) = (&problem.measurements[row], &fit.residuals[row]);
        let components = measurement.position_count() + measurement.orientation_count();
        residual.whitened_squared(&fit.noise).sqrt() > outlying_norm(components)
    };
    let outliers = (0..weights.len()).filter(outlies).collect();
    if known_noise.is_none() {
        fit = fit.with_redundancy(problem.redundancy(kept));
    }
    RobustFit { fit, weights, scale, outliers }
}

/// Norm of a row in units of the noise, scaled so that half of normal rows are within 0.6745, as of
/// one normal component.
pub(super) fn distance(measurement: &Measurement, residual: &Residual, noise: &Noise) -> f64 {
    let components = measurement.position_count() + measurement.orientation_count();
    residual.whitened_squared(noise).sqrt() * median_norm(1) / median_norm(components)
}

/// Of the halves found from least squares and from nominal the one that agrees better: a row that is
/// off by more than the reach drags least squares to where no half is right any more.
fn start_of_agreement(
    problem: &Problem<'_>,
    kept: &[usize],
    (plain, known_noise): (&Fit, Option<Noise>),
) -> Fit {
    let noise_of = |residuals: &[Residual]| {
        known_noise.unwrap_or_else(|| comparable_noise(problem, residuals)).floored()
    };
    let nothing = vec![0.0; plain.corrections.len()];
    let nominal = problem.residuals(&nothing);
    let found = [(plain.corrections.clone(), &plain.residuals), (nothing, &nominal)].map(
        |(corrections, residuals)| concentrated(problem, kept, (corrections, residuals, noise_of(residuals))),
    );
    let size = |fit: &Fit| {
        let Noise { position_m, orientation_rad } = comparable_noise(problem, &fit.residuals).floored();
        let count = |of: fn(&Measurement) -> usize| as_f64(problem.measurements.iter().map(of).sum());
        count(Measurement::position_count) * position_m.ln()
            + count(Measurement::orientation_count) * orientation_rad.ln()
    };
    let [from_plain, from_nominal] = found;
    if size(&from_nominal) < size(&from_plain) { from_nominal } else { from_plain }
}

/// Noise of the median row, neither kind so small against the other that it alone would decide.
fn comparable_noise(problem: &Problem<'_>, residuals: &[Residual]) -> Noise {
    let Noise { position_m, orientation_rad } = median_noise(problem, residuals, 1.0);
    let reach_m = problem.reach_m();
    Noise {
        position_m: position_m.max(LEAST_RATIO * orientation_rad * reach_m),
        orientation_rad: orientation_rad.max(LEAST_RATIO * position_m / reach_m),
    }
}

/// Least squares over that half of the rows which it fits best, found by leaving the worst half out
/// again and again: up to nearly half of the rows may be wrong.
///
/// Source: Rousseeuw & Van Driessen, *Computing LTS regression for large data sets* (2006), the
/// concentration step.
fn concentrated(
    problem: &Problem<'_>,
    kept: &[usize],
    (start, residuals, noise): (Vec<f64>, &[Residual], Noise),
) -> Fit {
    let rows = problem.measurements.len();
    // Half, and as many more as the corrections need.
    let per_row = (problem.component_count() / rows.max(1)).max(1);
    let half = (rows + kept.len().div_ceil(per_row)).div_ceil(2).min(rows);
    let nearest_half = |residuals: &[Residual]| {
        let distance = |row: &usize| distance(&problem.measurements[*row], &residuals[*row], &noise);
        let mut nearest: Vec<usize> = (0..rows).collect();
        nearest.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
        let mut chosen = vec![0.0; rows];
        nearest.iter().take(half).for_each(|&row| chosen[row] = 1.0);
        chosen
    };
    let fit_of = |start: Vec<f64>, chosen: &[f64]| {
        weighted_fit(problem, kept, start, &Weighting { noise, rows: chosen })
    };
    let mut chosen = nearest_half(residuals);
    let mut fit = fit_of(start, &chosen);
    for _ in 0..MOST_ROUNDS {
        let next = nearest_half(&fit.residuals);
        if next == chosen {
            break;
        }
        chosen = next;
        fit = fit_of(fit.corrections, &chosen);
    }
    fit
}

/// Noise of positions and of orientations from the median row, times a factor for what the fit
/// took out of it.
fn median_noise(problem: &Problem<'_>, residuals: &[Residual], factor: f64) -> Noise {
    let rows = || problem.measurements.iter().zip(residuals);
    let position = |(each, residual): (&Measurement, &Residual)| {
        let count = each.position_count();
        (count > 0).then(|| residual.position_m.norm() / median_norm(count))
    };
    let orientation = |(each, residual): (&Measurement, &Residual)| {
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
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}
