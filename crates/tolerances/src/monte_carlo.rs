//! The distribution of the error by draws of all parameters together, without linearisation.

use congruent_description::RobotQList;
use schemars::JsonSchema;
use serde::Serialize;

use crate::{
    error_chain::{ErrorChain, ErrorMotions},
    spread::{ErrorDraws, ErrorSpread},
};

/// Errors of the tool by Monte Carlo.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct MonteCarloError {
    /// Number of draws.
    pub samples: usize,
    /// Root mean square of the distance, m.
    pub rms_m: f64,
    /// Standard error of `rms_m`.
    pub rms_standard_error_m: f64,
    /// Distance that 95 % of the draws do not exceed, m.
    pub p95_m: f64,
    /// Distance that 99.7 % of the draws do not exceed, m.
    pub p997_m: f64,
    /// Between which distances the 99.7 % quantile is, with 95 % confidence, m.
    pub p997_between_m: [f64; 2],
    /// Largest distance of a draw, m.
    pub largest_m: f64,
    /// Root mean square of the angle, rad.
    pub rms_rad: f64,
    /// Angle that 95 % of the draws do not exceed, rad.
    pub p95_rad: f64,
    /// Angle that 99.7 % of the draws do not exceed, rad.
    pub p997_rad: f64,
    /// Largest angle of a draw, rad.
    pub largest_rad: f64,
}

/// How many draws are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Draws {
    pub(crate) samples: usize,
    pub(crate) seed: u64,
}

/// Draws errors at each of the configurations in turn, as many at each; at least one.
pub(crate) fn monte_carlo(
    chain: &ErrorChain,
    spread: &ErrorSpread,
    configurations: &RobotQList,
    Draws { samples, seed }: Draws,
) -> MonteCarloError {
    let count = configurations.len().max(1);
    let at_each = samples.div_ceil(count).max(1);
    let mut draws = ErrorDraws::new(spread, seed);
    let (mut errors, mut at) = (vec![0.0; spread.count()], ErrorMotions::default());
    let mut distances_m = Vec::with_capacity(at_each * count);
    let mut angles_rad = Vec::with_capacity(at_each * count);
    for q in configurations.iter() {
        chain.motions_into(&q, &mut at);
        for _ in 0..at_each {
            draws.draw(&mut errors);
            let found = at.tool_error(&errors);
            distances_m.push(found.shift_in_base.norm());
            angles_rad.push(found.angle_rad);
        }
    }
    summary(distances_m, angles_rad)
}

fn summary(mut distances_m: Vec<f64>, mut angles_rad: Vec<f64>) -> MonteCarloError {
    let [distance_square, deviation_of_mean] = mean_square(&distances_m);
    let [angle_square, _] = mean_square(&angles_rad);
    distances_m.sort_by(f64::total_cmp);
    angles_rad.sort_by(f64::total_cmp);
    let rms_m = distance_square.sqrt();
    MonteCarloError {
        samples: distances_m.len(),
        rms_m,
        // d sqrt(x) = dx / (2 sqrt x).
        rms_standard_error_m: if rms_m > 0.0 { deviation_of_mean / (2.0 * rms_m) } else { 0.0 },
        p95_m: quantile(&distances_m, 0.95, 0.0),
        p997_m: quantile(&distances_m, 0.997, 0.0),
        p997_between_m: [-1.96, 1.96].map(|sigmas| quantile(&distances_m, 0.997, sigmas)),
        largest_m: distances_m.last().copied().unwrap_or(0.0),
        rms_rad: angle_square.sqrt(),
        p95_rad: quantile(&angles_rad, 0.95, 0.0),
        p997_rad: quantile(&angles_rad, 0.997, 0.0),
        largest_rad: angles_rad.last().copied().unwrap_or(0.0),
    }
}

/// Mean of the squares, and its standard error.
#[expect(clippy::cast_precision_loss, reason = "far fewer than 2^52 draws")]
fn mean_square(values: &[f64]) -> [f64; 2] {
    let count = values.len() as f64;
    let mean = values.iter().map(|value| value * value).sum::<f64>() / count;
    let variance = values.iter().map(|value| (value * value - mean).powi(2)).sum::<f64>() / count;
    [mean, (variance / count).sqrt()]
}

/// Quantile of sorted values; with `sigmas`, the end of the interval in which the quantile of the distribution is: the number of
/// values below it is binomial.
#[expect(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "an index of a list that is in memory"
)]
fn quantile(sorted: &[f64], probability: f64, sigmas: f64) -> f64 {
    let count = sorted.len() as f64;
    let rank = count * probability + sigmas * (count * probability * (1.0 - probability)).sqrt();
    let index = (rank.ceil() - 1.0).clamp(0.0, (count - 1.0).max(0.0)) as usize;
    sorted.get(index).copied().unwrap_or(0.0)
}
