//! Functions that are affine in `(1, cos q, sin q)` of each turning joint and in `(1, q)` of each sliding one, by their
//! coefficients: gravity torques, and first moments. Entries of the mass matrix are quadratic in them: of second degree.

use std::f64::consts::TAU;

use super::measure::ValueMeasure;
use crate::thresholds::NO_COEFFICIENT;

/// A joint that the function depends on, with its range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::bound) struct Variable {
    pub(in crate::bound) joint: usize,
    /// 1, or 2 for squares as well.
    pub(in crate::bound) degree: usize,
    pub(in crate::bound) turns: bool,
    pub(in crate::bound) lower: f64,
    pub(in crate::bound) upper: f64,
}

impl Variable {
    /// The variable of a turning joint; a range beyond one turn is cut to one turn.
    pub(in crate::bound) fn turning(joint: usize, lower: f64, upper: f64) -> Self {
        Self { joint, degree: 1, turns: true, lower, upper: upper.min(lower + TAU) }
    }

    pub(in crate::bound) fn sliding(joint: usize, lower: f64, upper: f64) -> Self {
        Self { joint, degree: 1, turns: false, lower, upper }
    }

    /// Number of coefficients of this variable; those of all variables multiply.
    pub(in crate::bound) fn size(&self) -> usize {
        if self.turns { 1 + 2 * self.degree } else { 1 + self.degree }
    }

    /// Positions that determine the coefficients.
    pub(in crate::bound) fn samples(&self) -> Vec<f64> {
        let size = small(self.size());
        // Turning: equidistant positions around the circle, where the waves are orthogonal, so that the inverse
        // is a transpose. Sliding: both ends, and the middle for a square.
        let share = |at: u32| f64::from(at) / if self.turns { size } else { size - 1.0 };
        let shares = (0..).map(share).take(self.size());
        if self.turns {
            shares.map(|share| share * TAU).collect()
        } else {
            shares.map(|share| self.lower + share * (self.upper - self.lower)).collect()
        }
    }

    /// The functions that its coefficients multiply, at a position: 1, cos q, sin q, ... of a turning joint; powers of the
    /// position scaled to [-1, 1] of a sliding one.
    pub(in crate::bound) fn features(&self, q: f64) -> Vec<f64> {
        if !self.turns {
            let x = self.scaled(q);
            return (0..self.size()).map(|power| x.powi(i32::try_from(power).unwrap_or(0))).collect();
        }
        let waves = [1.0, libm::cos(q), libm::sin(q), libm::cos(2.0 * q), libm::sin(2.0 * q)];
        waves[..self.size()].to_vec()
    }

    fn scaled(&self, q: f64) -> f64 {
        let half = (self.upper - self.lower) / 2.0;
        if half > 0.0 { (q - self.lower) / half - 1.0 } else { 0.0 }
    }

    /// Matrix, by rows, from the values at the samples to the coefficients.
    pub(in crate::bound) fn coefficient_rows(&self) -> Vec<Vec<f64>> {
        if self.turns {
            // Discrete Fourier sums: mean for the constant, twice the mean for each wave.
            let scale = |row: usize| if row == 0 { 1.0 } else { 2.0 } / small(self.size());
            let features: Vec<Vec<f64>> = self.samples().iter().map(|q| self.features(*q)).collect();
            let row = |row: usize| features.iter().map(|at| at[row] * scale(row)).collect();
            return (0..self.size()).map(row).collect();
        }
        match (self.upper > self.lower, self.degree) {
            // Inverse of the interpolation at x = -1, 1 and, for squares, 0: the variable is scaled to [-1, 1].
            (true, 1) => vec![vec![0.5, 0.5], vec![-0.5, 0.5]],
            (true, _) => vec![vec![0.0, 1.0, 0.0], vec![-0.5, 0.0, 0.5], vec![0.5, -1.0, 0.5]],
            (false, degree) => {
                let mut rows = vec![vec![0.0; degree + 1]; degree + 1];
                rows[0][0] = 1.0;
                rows
            }
        }
    }
}

fn small(number: usize) -> f64 {
    f64::from(u32::try_from(number).unwrap_or(u32::MAX))
}

/// A function of several joints with several values.
#[derive(Debug, Clone)]
pub(in crate::bound) struct Trigonometric {
    pub(in crate::bound) variables: Vec<Variable>,
    /// Number of values at one position.
    pub(in crate::bound) values: usize,
    pub(in crate::bound) measure: ValueMeasure,
    /// Coefficients as a row-major array: the first variable is the slowest index, the value the fastest.
    pub(in crate::bound) coefficients: Vec<f64>,
    /// Upper bound of what left-out coefficients can add to the measure.
    pub(in crate::bound) slack: f64,
}

impl Trigonometric {
    /// Computes the coefficients from values at the sample positions of all variables; variables without effect are removed.
    pub(in crate::bound) fn sampled(
        variables: Vec<Variable>,
        values: usize,
        measure: ValueMeasure,
        mut function: impl FnMut(&[f64]) -> Vec<f64>,
    ) -> Self {
        let samples: Vec<Vec<f64>> = variables.iter().map(Variable::samples).collect();
        let count: usize = variables.iter().map(Variable::size).product();
        let mut coefficients = Vec::with_capacity(count * values);
        let mut q = vec![0.0; variables.len()];
        for index in 0..count {
            // Mixed-radix digits of the index, the last variable fastest: the order in which `along` reads the
            // array.
            let mut rest = index;
            for (at, samples) in samples.iter().enumerate().rev() {
                q[at] = samples[rest % samples.len()];
                rest /= samples.len();
            }
            coefficients.extend(function(&q));
        }
        let mut sizes: Vec<usize> = variables.iter().map(Variable::size).chain([values]).collect();
        for (at, variable) in variables.iter().enumerate() {
            // The samples are a tensor product, so each variable is transformed by itself: a sum instead of a
            // system of all coefficients.
            coefficients = along(&coefficients, &mut sizes, at, &variable.coefficient_rows());
        }
        let mut function = Self { variables, values, measure, coefficients, slack: 0.0 };
        function.reduce();
        function
    }

    /// The function of a range of the values alone.
    pub(in crate::bound) fn selected(&self, values: std::ops::Range<usize>, measure: ValueMeasure) -> Self {
        let of_all = self.coefficients.chunks_exact(self.values);
        let coefficients = of_all.flat_map(|all| all[values.clone()].iter().copied()).collect();
        let (variables, values) = (self.variables.clone(), values.len());
        let mut function = Self { variables, values, measure, coefficients, slack: self.slack };
        function.reduce();
        function
    }

    /// The dimensions of the array of coefficients: one for each variable, and the values last.
    pub(in crate::bound) fn sizes(&self) -> Vec<usize> {
        self.variables.iter().map(Variable::size).chain([self.values]).collect()
    }

    /// Removes variables whose effect is below rounding, and counts it as slack.
    fn reduce(&mut self) {
        let largest = self.coefficients.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
        // From the last, so that removing one does not move those that are still to be examined.
        for at in (0..self.variables.len()).rev() {
            let mut sizes = self.sizes();
            let mut constant = vec![vec![0.0; sizes[at]]];
            // Keeps the constant of this variable and drops its waves; what is dropped bounds the error, because
            // every wave is at most 1.
            constant[0][0] = 1.0;
            let total: f64 = self.coefficients.iter().map(|value| value.abs()).sum();
            let reduced = along(&self.coefficients, &mut sizes, at, &constant);
            let kept: f64 = reduced.iter().map(|value| value.abs()).sum();
            if total - kept <= NO_COEFFICIENT * largest {
                self.slack += total - kept;
                self.coefficients = reduced;
                self.variables.remove(at);
            }
        }
    }

    /// Most control values of the whole range: nine points for a full turn.
    pub(in crate::bound) fn control_values(&self) -> usize {
        let points = |variable: &Variable| if variable.turns { 9 } else { variable.size() };
        self.variables.iter().map(points).fold(self.values, usize::saturating_mul)
    }

    /// An upper bound without a search: the sum of the amplitudes of all harmonics. It is loose for many joints.
    pub(in crate::bound) fn sum_of_amplitudes(&self) -> f64 {
        let harmonic =
            |variable: &Variable, entry: usize| if variable.turns { entry.div_ceil(2) } else { entry };
        let count = |variable: &Variable| harmonic(variable, variable.size() - 1) + 1;
        let mut squares = vec![0.0; self.variables.iter().map(count).product::<usize>() * self.values];
        for (index, values) in self.coefficients.chunks_exact(self.values).enumerate() {
            // A cosine and a sine of the same harmonic have one amplitude, the root of the sum of their squares:
            // entries 1, 2 are the first harmonic, 3, 4 the second.
            let (mut rest, mut wave, mut stride) = (index, 0, 1);
            for variable in self.variables.iter().rev() {
                wave += harmonic(variable, rest % variable.size()) * stride;
                stride *= count(variable);
                rest /= variable.size();
            }
            let squares = &mut squares[wave * self.values..][..self.values];
            squares.iter_mut().zip(values).for_each(|(square, value)| *square += value * value);
        }
        squares.into_iter().map(f64::sqrt).sum::<f64>() + self.slack
    }

    /// The coefficients along one variable with the others at these positions.
    pub(in crate::bound) fn along_variable(&self, at: usize, q: &[f64]) -> Vec<f64> {
        let mut sizes = self.sizes();
        let mut coefficients = self.coefficients.clone();
        for (other, variable) in self.variables.iter().enumerate() {
            if other != at {
                let features = [variable.features(q[other])];
                coefficients = along(&coefficients, &mut sizes, other, &features);
            }
        }
        coefficients
    }

    /// The values of the function at these positions.
    pub(in crate::bound) fn at(&self, q: &[f64]) -> Vec<f64> {
        let mut sizes = self.sizes();
        let mut coefficients = self.coefficients.clone();
        for (at, variable) in self.variables.iter().enumerate() {
            coefficients = along(&coefficients, &mut sizes, at, &[variable.features(q[at])]);
        }
        coefficients
    }
}

/// Multiplies an array along one of its dimensions by a matrix, given by its rows; the size of the dimension becomes their
/// number.
pub(in crate::bound) fn along(array: &[f64], sizes: &mut [usize], at: usize, rows: &[Vec<f64>]) -> Vec<f64> {
    let mut result = Vec::new();
    along_into(array, sizes, at, rows, &mut result);
    result
}

/// The same as [`along`], into a vector that the caller reuses.
pub(in crate::bound) fn along_into(
    array: &[f64],
    sizes: &mut [usize],
    at: usize,
    rows: &[Vec<f64>],
    result: &mut Vec<f64>,
) {
    // The array is row-major: `before` outer blocks, then the dimension, then `after` contiguous values, which
    // the inner loop runs through without a stride.
    let before: usize = sizes[..at].iter().product();
    let after: usize = sizes[at + 1..].iter().product();
    let size = sizes[at];
    result.resize(before * rows.len() * after, 0.0);
    if array.is_empty() {
        return;
    }
    let blocks = array.chunks_exact(size * after).zip(result.chunks_exact_mut(rows.len() * after));
    for (block, targets) in blocks {
        for (row, target) in rows.iter().zip(targets.chunks_exact_mut(after)) {
            match row.len() {
                // A turning joint, of first and of second degree.
                3 => combine::<3>(row, block, target),
                5 => combine::<5>(row, block, target),
                _ => {
                    target.fill(0.0);
                    for (factor, source) in row.iter().zip(block.chunks_exact(after)) {
                        target.iter_mut().zip(source).for_each(|(target, source)| *target += factor * source);
                    }
                }
            }
        }
    }
    sizes[at] = rows.len();
}

/// The sum of the parts of a block, each with its factor, in one pass.
fn combine<const PARTS: usize>(factors: &[f64], block: &[f64], target: &mut [f64]) {
    let factors: [f64; PARTS] = std::array::from_fn(|at| factors[at]);
    let length = target.len();
    let parts: [&[f64]; PARTS] = std::array::from_fn(|at| &block[at * length..][..length]);
    for (at, target) in target.iter_mut().enumerate() {
        *target = factors.iter().zip(&parts).map(|(factor, part)| factor * part[at]).sum();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_are_of_second_degree() {
        let function = |q: &[f64]| vec![q[0].cos() * q[0].sin() * (1.0 + q[1] * q[1]) - q[0].sin()];
        let mut variables = vec![Variable::turning(0, -1.0, 2.0), Variable::sliding(1, -0.2, 0.7)];
        for variable in &mut variables {
            variable.degree = 2;
        }
        let found = Trigonometric::sampled(variables, 1, ValueMeasure::Sum, function);
        let q = [0.4, 0.6];
        assert!((found.at(&q)[0] - function(&q)[0]).abs() < 1e-15);
    }

    #[test]
    fn amplitudes_are_above_all_values() {
        let function = |q: &[f64]| vec![q[0].cos() * q[0].sin() * (1.0 + q[1] * q[1]) - q[0].sin() * q[1]];
        let mut variables = vec![Variable::turning(0, -3.0, 3.0), Variable::sliding(1, -1.0, 1.0)];
        for variable in &mut variables {
            variable.degree = 2;
        }
        let found = Trigonometric::sampled(variables, 1, ValueMeasure::Sum, function);
        // sin(2 a) / 2 and b^2 sin(2 a) / 2 and b sin(a).
        assert!((found.sum_of_amplitudes() - 2.0).abs() < 1e-12);
    }

    #[test]
    fn coefficients_give_the_function_back() {
        let function = |q: &[f64]| vec![2.0 + q[0].cos() * (q[2] - 0.3) - 0.5 * q[2] * q[0].sin()];
        let variables = vec![
            Variable::turning(0, -1.0, 9.0),
            Variable::turning(1, -1.0, 1.0),
            Variable::sliding(2, 0.1, 0.7),
        ];
        let found = Trigonometric::sampled(variables, 1, ValueMeasure::Sum, function);
        assert_eq!(found.variables.len(), 2, "the second has no effect");
        let q = [0.4, 0.6];
        assert!((found.at(&q)[0] - function(&[0.4, 0.0, 0.6])[0]).abs() < 1e-15);
        let one = found.along_variable(0, &q);
        let again = one[0] + one[1] * 0.4_f64.cos() + one[2] * 0.4_f64.sin();
        assert!((again - found.at(&q)[0]).abs() < 1e-15);
    }
}
