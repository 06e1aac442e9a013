//! Functions that are affine in `(1, cos q, sin q)` of each turning joint and in `(1, q)` of each sliding one, by their
//! coefficients: gravity torques, and first moments. Entries of the mass matrix are quadratic in them: of second degree.

use std::f64::consts::TAU;

use congruent_description::Elementary as _;

use super::measure::Measure;
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
    /// Of a turning joint; a range beyond one turn is one turn.
    pub(in crate::bound) fn turning(joint: usize, (lower, upper): (f64, f64)) -> Self {
        Self { joint, degree: 1, turns: true, lower, upper: upper.min(lower + TAU) }
    }

    pub(in crate::bound) fn sliding(joint: usize, (lower, upper): (f64, f64)) -> Self {
        Self { joint, degree: 1, turns: false, lower, upper }
    }

    /// How many coefficients it multiplies the others by.
    pub(in crate::bound) fn size(&self) -> usize {
        if self.turns { 1 + 2 * self.degree } else { 1 + self.degree }
    }

    /// Positions that determine the coefficients.
    pub(in crate::bound) fn samples(&self) -> Vec<f64> {
        let size = small(self.size());
        let share = |at: u32| f64::from(at) / if self.turns { size } else { size - 1.0 };
        let shares = (0..).map(share).take(self.size());
        if self.turns {
            shares.map(|share| share * TAU).collect()
        } else {
            shares.map(|share| self.lower + share * (self.upper - self.lower)).collect()
        }
    }

    /// What its coefficients multiply at a position; of a sliding joint scaled to its range.
    pub(in crate::bound) fn features(&self, q: f64) -> Vec<f64> {
        if !self.turns {
            let x = self.scaled(q);
            return (0..self.size()).map(|power| x.powi(i32::try_from(power).unwrap_or(0))).collect();
        }
        let waves = [1.0, q.cosine(), q.sine(), (2.0 * q).cosine(), (2.0 * q).sine()];
        waves[..self.size()].to_vec()
    }

    fn scaled(&self, q: f64) -> f64 {
        let half = (self.upper - self.lower) / 2.0;
        if half > 0.0 { (q - self.lower) / half - 1.0 } else { 0.0 }
    }

    /// Rows that give the coefficients by the values at the samples.
    pub(in crate::bound) fn coefficient_rows(&self) -> Vec<Vec<f64>> {
        if self.turns {
            let scale = |row: usize| if row == 0 { 1.0 } else { 2.0 } / small(self.size());
            let features: Vec<Vec<f64>> = self.samples().iter().map(|q| self.features(*q)).collect();
            let row = |row: usize| features.iter().map(|at| at[row] * scale(row)).collect();
            return (0..self.size()).map(row).collect();
        }
        match (self.upper > self.lower, self.degree) {
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
    /// How many values it has.
    pub(in crate::bound) values: usize,
    pub(in crate::bound) measure: Measure,
    /// By the coefficient of the first variable, then the second, ..., then the value.
    pub(in crate::bound) coefficients: Vec<f64>,
    /// The most that left out coefficients can add to the norm.
    pub(in crate::bound) slack: f64,
}

impl Trigonometric {
    /// Finds the coefficients from values at positions of all variables; joints without effect are left out.
    pub(in crate::bound) fn sampled(
        variables: Vec<Variable>,
        (values, measure): (usize, Measure),
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
        let mut function = Self { variables, values, measure, coefficients, slack: 0.0 };
        function.reduce();
        function
    }

    /// The function of some of the values alone, which stand side by side.
    pub(in crate::bound) fn selected(&self, values: std::ops::Range<usize>, measure: Measure) -> Self {
        let of_all = self.coefficients.chunks_exact(self.values);
        let coefficients = of_all.flat_map(|all| all[values.clone()].iter().copied()).collect();
        let (variables, values) = (self.variables.clone(), values.len());
        let mut function = Self { variables, values, measure, coefficients, slack: self.slack };
        function.reduce();
        function
    }

    pub(in crate::bound) fn sizes(&self) -> Vec<usize> {
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

    /// How many control values a whole range has, at most.
    pub(in crate::bound) fn control_values(&self) -> usize {
        let points = |variable: &Variable| if variable.turns { 9 } else { variable.size() };
        self.variables.iter().map(points).fold(self.values, usize::saturating_mul)
    }

    /// The sum of the amplitudes of all waves, each value for itself: no search, but far above for many joints.
    pub(in crate::bound) fn sum_of_amplitudes(&self) -> f64 {
        let harmonic =
            |variable: &Variable, entry: usize| if variable.turns { entry.div_ceil(2) } else { entry };
        let count = |variable: &Variable| harmonic(variable, variable.size() - 1) + 1;
        let mut squares = vec![0.0; self.variables.iter().map(count).product::<usize>() * self.values];
        for (index, values) in self.coefficients.chunks_exact(self.values).enumerate() {
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

    /// The function of one variable with the others at these positions: its coefficients, one row a value.
    pub(in crate::bound) fn of_one(&self, at: usize, q: &[f64]) -> Vec<f64> {
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
    pub(in crate::bound) fn at(&self, q: &[f64]) -> Vec<f64> {
        let mut sizes = self.sizes();
        let mut coefficients = self.coefficients.clone();
        for (at, variable) in self.variables.iter().enumerate() {
            coefficients = along(&coefficients, (&mut sizes, self.values), at, &[variable.features(q[at])]);
        }
        coefficients
    }
}

/// Multiplies an array along one of its dimensions by a matrix, given by its rows; the dimension gets their number.
pub(in crate::bound) fn along(
    array: &[f64],
    (sizes, values): (&mut [usize], usize),
    at: usize,
    rows: &[Vec<f64>],
) -> Vec<f64> {
    let mut result = Vec::new();
    along_into(array, (sizes, values), (at, rows), &mut result);
    result
}

/// The same into memory that is used again.
pub(in crate::bound) fn along_into(
    array: &[f64],
    (sizes, values): (&mut [usize], usize),
    (at, rows): (usize, &[Vec<f64>]),
    result: &mut Vec<f64>,
) {
    let before: usize = sizes[..at].iter().product();
    let after: usize = sizes[at + 1..].iter().product::<usize>() * values;
    let size = sizes[at];
    result.clear();
    result.resize(before * rows.len() * after, 0.0);
    for outer in 0..before {
        for (row_at, row) in rows.iter().enumerate() {
            let target = &mut result[(outer * rows.len() + row_at) * after..][..after];
            for (entry, factor) in row.iter().enumerate().filter(|(_, factor)| **factor != 0.0) {
                let source = &array[(outer * size + entry) * after..][..after];
                target.iter_mut().zip(source).for_each(|(target, source)| *target += factor * source);
            }
        }
    }
    sizes[at] = rows.len();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_are_of_second_degree() {
        let function = |q: &[f64]| vec![q[0].cos() * q[0].sin() * (1.0 + q[1] * q[1]) - q[0].sin()];
        let mut variables = vec![Variable::turning(0, (-1.0, 2.0)), Variable::sliding(1, (-0.2, 0.7))];
        for variable in &mut variables {
            variable.degree = 2;
        }
        let found = Trigonometric::sampled(variables, (1, Measure::Sum), function);
        let q = [0.4, 0.6];
        assert!((found.at(&q)[0] - function(&q)[0]).abs() < 1e-15);
    }

    #[test]
    fn amplitudes_are_above_all_values() {
        let function = |q: &[f64]| vec![q[0].cos() * q[0].sin() * (1.0 + q[1] * q[1]) - q[0].sin() * q[1]];
        let mut variables = vec![Variable::turning(0, (-3.0, 3.0)), Variable::sliding(1, (-1.0, 1.0))];
        for variable in &mut variables {
            variable.degree = 2;
        }
        let found = Trigonometric::sampled(variables, (1, Measure::Sum), function);
        // sin(2 a) / 2 and b^2 sin(2 a) / 2 and b sin(a).
        assert!((found.sum_of_amplitudes() - 2.0).abs() < 1e-12);
    }

    #[test]
    fn coefficients_give_the_function_back() {
        let function = |q: &[f64]| vec![2.0 + q[0].cos() * (q[2] - 0.3) - 0.5 * q[2] * q[0].sin()];
        let variables = vec![
            Variable::turning(0, (-1.0, 9.0)),
            Variable::turning(1, (-1.0, 1.0)),
            Variable::sliding(2, (0.1, 0.7)),
        ];
        let found = Trigonometric::sampled(variables, (1, Measure::Sum), function);
        assert_eq!(found.variables.len(), 2, "the second has no effect");
        let q = [0.4, 0.6];
        assert!((found.at(&q)[0] - function(&[0.4, 0.0, 0.6])[0]).abs() < 1e-15);
        let one = found.of_one(0, &q);
        let again = one[0] + one[1] * 0.4_f64.cos() + one[2] * 0.4_f64.sin();
        assert!((again - found.at(&q)[0]).abs() < 1e-15);
    }
}
