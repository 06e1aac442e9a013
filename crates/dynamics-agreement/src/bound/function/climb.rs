//! The largest absolute value of a function of joint positions, from below: one joint at a time, each exactly.

use super::{
    measure::Measure,
    trigonometric::{Trigonometric, Variable},
};
use congruent_description::Elementary as _;
use congruent_kinematics::Uniform;

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
pub(in crate::bound) fn largest(function: &Trigonometric, seed: u64) -> (f64, Vec<f64>) {
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

/// A function of several values of which only its course along one variable is asked.
pub(in crate::bound) struct Course<'a, F> {
    pub(in crate::bound) variables: &'a [Variable],
    pub(in crate::bound) measure: Measure,
    /// The coefficients along one variable with the others at these positions: the values, for each feature of it.
    pub(in crate::bound) of_one: F,
}

/// The same for the measure of a function of several values, or of second degree: the best of many positions of each
/// joint, refined.
pub(in crate::bound) fn largest_sampled<F: FnMut(usize, &[f64]) -> Vec<f64>>(
    mut course: Course<'_, F>,
    seed: u64,
) -> (f64, Vec<f64>) {
    let mut random = Uniform::seeded(seed);
    let climbed = (0..STARTS).map(|_| {
        let draw = |variable: &Variable| random.between((variable.lower, variable.upper));
        let mut q: Vec<f64> = course.variables.iter().map(draw).collect();
        let mut best = 0.0;
        for _ in 0..ROUNDS {
            let before = best;
            for at in 0..q.len() {
                let coefficients = (course.of_one)(at, &q);
                let along = (&course.variables[at], &coefficients[..]);
                (best, q[at]) = best_of_one(along, course.measure, q[at]);
            }
            if best - before <= LEAST_GAIN_SAMPLED * best {
                break;
            }
        }
        (best, q)
    });
    climbed.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, Vec::new()))
}

/// The largest measure that climbing from one position finds.
pub(in crate::bound) fn largest_from(function: &Trigonometric, mut q: Vec<f64>) -> f64 {
    let mut best = 0.0;
    for _ in 0..ROUNDS {
        let before = best;
        for at in 0..q.len() {
            let coefficients = function.of_one(at, &q);
            (best, q[at]) = best_of_one((&function.variables[at], &coefficients), function.measure, q[at]);
        }
        if best - before <= LEAST_GAIN_SAMPLED * best {
            break;
        }
    }
    if q.is_empty() { function.measure.of(&function.at(&q)) } else { best }
}

/// Positions of one joint that are tried before the best is refined. Kind: choice; waves of second degree have four
/// slopes a turn.
const POSITIONS: u32 = 24;
/// Halvings of the interval around the best one. Kind: choice, to 3e-6 of the range: a maximum is flat, and its value
/// good to the square of that.
const HALVINGS: usize = 14;
/// A round that gains less than this share is the last. No unit; kind: solver stop.
const LEAST_GAIN_SAMPLED: f64 = 1e-6;

/// The largest measure along one joint, at least that of where it is.
fn best_of_one((variable, coefficients): (&Variable, &[f64]), measure: Measure, q: f64) -> (f64, f64) {
    let count = coefficients.len() / variable.size();
    let mut values = vec![0.0; count];
    let mut value = |q: f64| {
        values.fill(0.0);
        for (feature, row) in variable.features(q).iter().zip(coefficients.chunks_exact(count)) {
            values.iter_mut().zip(row).for_each(|(value, coefficient)| *value += feature * coefficient);
        }
        measure.of(&values)
    };
    let step = (variable.upper - variable.lower) / f64::from(POSITIONS);
    let grid = (0..=POSITIONS).map(|index| variable.lower + step * f64::from(index));
    let (mut best, mut place) = (value(q), q);
    let mut width = step;
    for candidate in grid {
        let found = value(candidate);
        if found > best {
            (best, place) = (found, candidate);
        }
    }
    for _ in 0..HALVINGS {
        let beside = [place - width, place + width].map(|q| q.clamp(variable.lower, variable.upper));
        for (found, candidate) in beside.map(|q| (value(q), q)) {
            if found > best {
                (best, place) = (found, candidate);
            }
        }
        width /= 2.0;
    }
    (best, place)
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
        let top = coefficients[2].arctangent_over(coefficients[1]);
        for turns in -4..=4 {
            let q = top + f64::from(turns) * std::f64::consts::PI;
            if (variable.lower..=variable.upper).contains(&q) {
                found.push(q);
            }
        }
    }
    found
}
