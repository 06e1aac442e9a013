//! Functions that are affine in `(1, cos q, sin q)` of each turning joint and in `(1, q)` of each sliding one, by their
//! coefficients: gravity torques, and first moments.

use std::f64::consts::TAU;

use crate::thresholds::NO_COEFFICIENT;

/// A joint that the function depends on, with its range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Variable {
    pub(super) joint: usize,
    pub(super) turns: bool,
    pub(super) lower: f64,
    pub(super) upper: f64,
}

impl Variable {
    /// Of a turning joint; a range beyond one turn is one turn.
    pub(super) fn turning(joint: usize, (lower, upper): (f64, f64)) -> Self {
        Self { joint, turns: true, lower, upper: upper.min(lower + TAU) }
    }

    pub(super) fn sliding(joint: usize, (lower, upper): (f64, f64)) -> Self {
        Self { joint, turns: false, lower, upper }
    }

    /// How many coefficients it multiplies the others by.
    fn size(&self) -> usize {
        if self.turns { 3 } else { 2 }
    }

    /// Positions that determine the coefficients.
    fn samples(&self) -> Vec<f64> {
        if self.turns { vec![0.0, TAU / 3.0, TAU * 2.0 / 3.0] } else { vec![self.lower, self.upper] }
    }

    /// What its coefficients multiply at a position; of a sliding joint scaled to its range.
    pub(super) fn features(&self, q: f64) -> Vec<f64> {
        if self.turns { vec![1.0, q.cos(), q.sin()] } else { vec![1.0, self.scaled(q)] }
    }

    fn scaled(&self, q: f64) -> f64 {
        let half = (self.upper - self.lower) / 2.0;
        if half > 0.0 { (q - self.lower) / half - 1.0 } else { 0.0 }
    }

    /// Rows that give the coefficients by the values at the samples.
    fn coefficient_rows(&self) -> Vec<Vec<f64>> {
        if !self.turns {
            return if self.upper > self.lower {
                vec![vec![0.5, 0.5], vec![-0.5, 0.5]]
            } else {
                vec![vec![1.0, 0.0], vec![0.0, 0.0]]
            };
        }
        let samples = self.samples();
        let row = |of: fn(f64) -> f64| samples.iter().map(|q| of(*q) * 2.0 / 3.0).collect();
        vec![vec![1.0 / 3.0; 3], row(f64::cos), row(f64::sin)]
    }
}

/// A function of several joints with several values.
#[derive(Debug, Clone)]
pub(super) struct Trigonometric {
    pub(super) variables: Vec<Variable>,
    /// How many values it has.
    pub(super) values: usize,
    /// By the coefficient of the first variable, then the second, ..., then the value.
    pub(super) coefficients: Vec<f64>,
    /// The most that left out coefficients can add to the norm.
    pub(super) slack: f64,
}

impl Trigonometric {
    /// Finds the coefficients from values at `(variable, position)` of each; joints without effect are left out.
    pub(super) fn sampled(
        variables: Vec<Variable>,
        values: usize,
        mut function: impl FnMut(&[f64]) -> Vec<f64>,
    ) -> Self {
        let samples: Vec<Vec<f64>> = variables.iter().map(Variable::samples).collect();
        let count: usize = variables.iter().map(Variable::size).product();
        let mut coefficients = Vec::with_capacity(count * values);
        let mut q = vec![0.0; variables.len()];
        for index in 0..count {
            let mut rest = index;
            for (at, samples) in samples.iter().enumerate().rev() {
                q[at] = samples[rest % samples.len()];
                rest /= samples.len();
            }
            coefficients.extend(function(&q));
        }
        let mut sizes: Vec<usize> = variables.iter().map(Variable::size).collect();
        for (at, variable) in variables.iter().enumerate() {
            coefficients = along(&coefficients, (&mut sizes, values), at, &variable.coefficient_rows());
        }
        let mut function = Self { variables, values, coefficients, slack: 0.0 };
        function.reduce();
        function
    }

    pub(super) fn sizes(&self) -> Vec<usize> {
        self.variables.iter().map(Variable::size).collect()
    }

    /// Leaves out what has no effect but rounding.
    fn reduce(&mut self) {
        let largest = self.coefficients.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
        for at in (0..self.variables.len()).rev() {
            let mut sizes = self.sizes();
            let mut constant = vec![vec![0.0; sizes[at]]];
            constant[0][0] = 1.0;
            let total: f64 = self.coefficients.iter().map(|value| value.abs()).sum();
            let reduced = along(&self.coefficients, (&mut sizes, self.values), at, &constant);
            let kept: f64 = reduced.iter().map(|value| value.abs()).sum();
            if total - kept <= NO_COEFFICIENT * largest {
                self.slack += total - kept;
                self.coefficients = reduced;
                self.variables.remove(at);
            }
        }
    }

    /// The function of one variable with the others at these positions: its coefficients, one row a value.
    pub(super) fn of_one(&self, at: usize, q: &[f64]) -> Vec<f64> {
        let mut sizes = self.sizes();
        let mut coefficients = self.coefficients.clone();
        for (other, variable) in self.variables.iter().enumerate() {
            if other != at {
                let features = [variable.features(q[other])];
                coefficients = along(&coefficients, (&mut sizes, self.values), other, &features);
            }
        }
        coefficients
    }

    /// The values at these positions.
    pub(super) fn at(&self, q: &[f64]) -> Vec<f64> {
        let mut sizes = self.sizes();
        let mut coefficients = self.coefficients.clone();
        for (at, variable) in self.variables.iter().enumerate() {
            coefficients = along(&coefficients, (&mut sizes, self.values), at, &[variable.features(q[at])]);
        }
        coefficients
    }
}

/// Multiplies an array along one of its dimensions by a matrix, given by its rows; the dimension gets their number.
pub(super) fn along(
    array: &[f64],
    (sizes, values): (&mut [usize], usize),
    at: usize,
    rows: &[Vec<f64>],
) -> Vec<f64> {
    let before: usize = sizes[..at].iter().product();
    let after: usize = sizes[at + 1..].iter().product::<usize>() * values;
    let size = sizes[at];
    let mut result = vec![0.0; before * rows.len() * after];
    for outer in 0..before {
        for (row_at, row) in rows.iter().enumerate() {
            let target = &mut result[(outer * rows.len() + row_at) * after..][..after];
            for (entry, factor) in row.iter().enumerate() {
                let source = &array[(outer * size + entry) * after..][..after];
                target.iter_mut().zip(source).for_each(|(target, source)| *target += factor * source);
            }
        }
    }
    sizes[at] = rows.len();
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coefficients_give_the_function_back() {
        let function = |q: &[f64]| vec![2.0 + q[0].cos() * (q[2] - 0.3) - 0.5 * q[2] * q[0].sin()];
        let variables = vec![
            Variable::turning(0, (-1.0, 9.0)),
            Variable::turning(1, (-1.0, 1.0)),
            Variable::sliding(2, (0.1, 0.7)),
        ];
        let found = Trigonometric::sampled(variables, 1, function);
        assert_eq!(found.variables.len(), 2, "the second has no effect");
        let q = [0.4, 0.6];
        assert!((found.at(&q)[0] - function(&[0.4, 0.0, 0.6])[0]).abs() < 1e-15);
        let one = found.of_one(0, &q);
        let again = one[0] + one[1] * 0.4_f64.cos() + one[2] * 0.4_f64.sin();
        assert!((again - found.at(&q)[0]).abs() < 1e-15);
    }
}
