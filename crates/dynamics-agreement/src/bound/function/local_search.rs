//! A lower bound of the largest absolute value of a function of joint positions, by coordinate search.

use congruent_kinematics::Uniform;

use super::{
    measure::ValueMeasure,
    trigonometric::{Trigonometric, Variable},
};

/// Random positions, the best of which start a search. Kind: choice.
const SAMPLES: usize = 200;
/// Number of searches. Kind: choice.
const STARTS: usize = 6;
/// Most rounds over all joints. Kind: loop bound; some ten suffice on most arms.
const ROUNDS: usize = 200;
/// Most doublings of a step. Kind: loop bound.
const MOST_DOUBLINGS: u32 = 16;
/// A round that gains less than this share is the last. No unit; kind: solver stop.
const LEAST_GAIN: f64 = 1e-14;

/// The largest absolute value that was found, with its positions, one for each variable.
pub(in crate::bound) fn largest(function: &Trigonometric, seed: u64) -> (f64, Vec<f64>) {
    let mut random = Uniform::seeded(seed);
    let value = |q: &[f64]| function.at(q)[0].abs();
    let mut starts: Vec<(f64, Vec<f64>)> = (0..SAMPLES)
        .map(|_| {
            let draw = |variable: &Variable| random.between(variable.lower, variable.upper);
            let q: Vec<f64> = function.variables.iter().map(draw).collect();
            (value(&q), q)
        })
        .collect();
    // Sampling is cheap against a search, so many samples choose few starts; several starts, because the function
    // has more than one maximum.
    starts.sort_by(|a, b| b.0.total_cmp(&a.0));
    starts.truncate(STARTS);
    let maxima = starts.into_iter().map(|(_, q)| ascend(function, q));
    maxima.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, Vec::new()))
}

/// The largest absolute value that coordinate searches from three positions find.
pub(in crate::bound) fn largest_of_three(function: &Trigonometric) -> f64 {
    let starts = [0.5, 0.25, 0.75].map(|share| {
        let at = |variable: &Variable| variable.lower + share * (variable.upper - variable.lower);
        function.variables.iter().map(at).collect::<Vec<f64>>()
    });
    let maxima = starts.into_iter().map(|q| largest_from(function, q));
    maxima.fold(0.0, f64::max)
}

/// A function of several values that is evaluated along one variable at a time.
pub(in crate::bound) struct SectionedFunction<'a, F> {
    pub(in crate::bound) variables: &'a [Variable],
    pub(in crate::bound) measure: ValueMeasure,
    /// The coefficients along one variable with the others at these positions: the values, for each feature of it.
    pub(in crate::bound) along_variable: F,
}

/// The same for the measure of a function with several values or of second degree: for each joint the best of many positions,
/// refined by halving.
pub(in crate::bound) fn largest_sampled<F: FnMut(usize, &[f64]) -> Vec<f64>>(
    mut sectioned: SectionedFunction<'_, F>,
    seed: u64,
) -> (f64, Vec<f64>) {
    let mut random = Uniform::seeded(seed);
    let maxima = (0..STARTS).map(|_| {
        let draw = |variable: &Variable| random.between(variable.lower, variable.upper);
        let mut q: Vec<f64> = sectioned.variables.iter().map(draw).collect();
        let mut best = 0.0;
        for _ in 0..ROUNDS {
            let before = best;
            for at in 0..q.len() {
                let coefficients = (sectioned.along_variable)(at, &q);
                let variable = &sectioned.variables[at];
                // The best of one joint includes its present position, so the value never falls, and the loop
                // ends.
                (best, q[at]) = best_of_one(variable, &coefficients, sectioned.measure, q[at]);
            }
            if best - before <= LEAST_GAIN_SAMPLED * best {
                break;
            }
        }
        (best, q)
    });
    maxima.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, Vec::new()))
}

/// The largest measure that a coordinate search from one position finds.
pub(in crate::bound) fn largest_from(function: &Trigonometric, mut q: Vec<f64>) -> f64 {
    let mut best = 0.0;
    for _ in 0..ROUNDS {
        let before = best;
        for at in 0..q.len() {
            let coefficients = function.along_variable(at, &q);
            (best, q[at]) = best_of_one(&function.variables[at], &coefficients, function.measure, q[at]);
        }
        if best - before <= LEAST_GAIN_SAMPLED * best {
            break;
        }
    }
    // Without a variable no round was made: the function is a constant.
    if q.is_empty() { function.measure.value(&function.at(&q)) } else { best }
}

/// Positions of one joint that are tried before the best is refined. Kind: choice; a function of second degree has up to two
/// maxima in a turn.
const POSITIONS: u32 = 24;
/// Halvings of the interval around the best one. Kind: choice, to 3e-6 of the range; at a maximum the slope is zero, so the
/// value is accurate to the square of that.
const HALVINGS: usize = 14;
/// A round that gains less than this share is the last. No unit; kind: solver stop.
const LEAST_GAIN_SAMPLED: f64 = 1e-6;

/// The largest measure along one joint and its position; never less than at the present position `q`.
fn best_of_one(variable: &Variable, coefficients: &[f64], measure: ValueMeasure, q: f64) -> (f64, f64) {
    let count = coefficients.len() / variable.size();
    let mut values = vec![0.0; count];
    let mut value = |q: f64, least: f64| {
        values.fill(0.0);
        for (feature, row) in variable.features(q).iter().zip(coefficients.chunks_exact(count)) {
            values.iter_mut().zip(row).for_each(|(value, coefficient)| *value += feature * coefficient);
        }
        measure.value_above(&values, least)
    };
    let step = (variable.upper - variable.lower) / f64::from(POSITIONS);
    let grid = (0..=POSITIONS).map(|index| variable.lower + step * f64::from(index));
    let (mut best, mut place) = (value(q, f64::NEG_INFINITY), q);
    // The halving starts at one step of the grid, because the maximum lies within one step of the best position.
    let mut width = step;
    for candidate in grid {
        let found = value(candidate, best);
        if found > best {
            (best, place) = (found, candidate);
        }
    }
    for _ in 0..HALVINGS {
        let beside = [place - width, place + width].map(|q| q.clamp(variable.lower, variable.upper));
        for candidate in beside {
            let found = value(candidate, best);
            if found > best {
                (best, place) = (found, candidate);
            }
        }
        width /= 2.0;
    }
    (best, place)
}

fn ascend(function: &Trigonometric, mut q: Vec<f64>) -> (f64, Vec<f64>) {
    let mut best = function.at(&q)[0].abs();
    for _ in 0..ROUNDS {
        let (before, from) = (best, q.clone());
        for (at, variable) in function.variables.iter().enumerate() {
            let coefficients = function.along_variable(at, &q);
            // Along one joint the function is a + b cos q + c sin q, whose extremes are known: no grid is needed.
            for candidate in candidates(variable, &coefficients) {
                let features = variable.features(candidate);
                let value: f64 = features.iter().zip(&coefficients).map(|(a, b)| a * b).sum();
                if value.abs() > best {
                    best = value.abs();
                    q[at] = candidate;
                }
            }
        }
        // Coordinate steps zigzag along a ridge where two joints compensate each other; the direction of the
        // round goes along it.
        run_on(function, &from, &mut q, &mut best);
        if best - before <= LEAST_GAIN * best {
            break;
        }
    }
    (best, q)
}

/// Continues in the direction of a round, twice as far each time, as long as the value grows.
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

/// Positions at which a function of one joint can have its largest absolute value within the range.
fn candidates(variable: &Variable, coefficients: &[f64]) -> Vec<f64> {
    let mut found = vec![variable.lower, variable.upper];
    if variable.turns {
        // d/dq (a + b cos q + c sin q) = 0 at tan q = c / b: a maximum and, half a turn further, a minimum. Both,
        // since the absolute value is meant.
        let top = libm::atan2(coefficients[2], coefficients[1]);
        // A range may begin anywhere within some turns of zero; it is at most one turn wide.
        for turns in -4..=4 {
            let q = top + f64::from(turns) * std::f64::consts::PI;
            if (variable.lower..=variable.upper).contains(&q) {
                found.push(q);
            }
        }
    }
    found
}
