//! The largest absolute value of a function of joint positions, from below: one joint at a time, each exactly.

use super::trigonometric::{Trigonometric, Variable};
use crate::torque::states::Uniform;

/// Random positions of which the best are climbed from. Kind: choice.
const SAMPLES: usize = 200;
/// How many are climbed from. Kind: choice.
const STARTS: usize = 6;
/// Most rounds over all joints. Kind: loop bound; some ten suffice on most arms.
const ROUNDS: usize = 200;
/// How often a step is doubled. Kind: loop bound.
const MOST_DOUBLINGS: u32 = 16;
/// A round that gains less than this share is the last. No unit; kind: solver stop.
const LEAST_GAIN: f64 = 1e-14;

/// The largest absolute value that was found, with its positions, one for each variable.
pub(super) fn largest(function: &Trigonometric, seed: u64) -> (f64, Vec<f64>) {
    let mut random = Uniform::seeded(seed);
    let value = |q: &[f64]| function.at(q)[0].abs();
    let mut starts: Vec<(f64, Vec<f64>)> = (0..SAMPLES)
        .map(|_| {
            let draw = |variable: &Variable| random.between((variable.lower, variable.upper));
            let q: Vec<f64> = function.variables.iter().map(draw).collect();
            (value(&q), q)
        })
        .collect();
    starts.sort_by(|a, b| b.0.total_cmp(&a.0));
    starts.truncate(STARTS);
    let climbed = starts.into_iter().map(|(_, q)| climb(function, q));
    climbed.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, Vec::new()))
}

fn climb(function: &Trigonometric, mut q: Vec<f64>) -> (f64, Vec<f64>) {
    let mut best = function.at(&q)[0].abs();
    for _ in 0..ROUNDS {
        let (before, from) = (best, q.clone());
        for (at, variable) in function.variables.iter().enumerate() {
            let coefficients = function.of_one(at, &q);
            for candidate in candidates(variable, &coefficients) {
                let features = variable.features(candidate);
                let value: f64 = features.iter().zip(&coefficients).map(|(a, b)| a * b).sum();
                if value.abs() > best {
                    best = value.abs();
                    q[at] = candidate;
                }
            }
        }
        run_on(function, &from, &mut q, &mut best);
        if best - before <= LEAST_GAIN * best {
            break;
        }
    }
    (best, q)
}

/// Goes on in the direction of a round, twice as far each time, as long as it gains: rounds alone are slow on a ridge.
fn run_on(function: &Trigonometric, from: &[f64], q: &mut Vec<f64>, best: &mut f64) {
    let direction: Vec<f64> = q.iter().zip(from).map(|(to, from)| to - from).collect();
    for doubling in 0..MOST_DOUBLINGS {
        let far = f64::from(1_u32 << doubling);
        let ahead = q.iter().zip(&direction).zip(&function.variables);
        let next: Vec<f64> =
            ahead.map(|((q, by), variable)| (q + far * by).clamp(variable.lower, variable.upper)).collect();
        let value = function.at(&next)[0].abs();
        if value <= *best {
            break;
        }
        (*q, *best) = (next, value);
    }
}

/// Where a function of one joint can be largest within its range.
fn candidates(variable: &Variable, coefficients: &[f64]) -> Vec<f64> {
    let mut found = vec![variable.lower, variable.upper];
    if variable.turns {
        let top = coefficients[2].atan2(coefficients[1]);
        for turns in -4..=4 {
            let q = top + f64::from(turns) * std::f64::consts::PI;
            if (variable.lower..=variable.upper).contains(&q) {
                found.push(q);
            }
        }
    }
    found
}
