//! How hypotheses are fitted and compared.

use congruent_scenario::RunFault;
use nalgebra::{DMatrix, DVector};

/// Largest relative residual of a hypothesis that explains a difference. Kind: ratio of root mean squares. The residual of a
/// right hypothesis is the difference of engine and inverse dynamics in a step, some hundredths of a small fault; that of a
/// constant fitted to a line, or of a line fitted to a sine, is about half.
pub(super) const EXPLAINED: f64 = 0.1;
/// Each parameter of a hypothesis must lower the residual to this part: any additional parameter lowers it a little.
const COMPLEXITY_PER_PARAMETER: f64 = 1.0 / 3.0;
/// Smaller relative residuals count as equal.
const NEGLIGIBLE: f64 = 1e-3;

/// A range of kept samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Window {
    pub(super) first: usize,
    /// The sample after the last.
    pub(super) end: usize,
}

impl Window {
    /// From the first to the last sample of which `is_off` holds.
    pub(super) fn spanning(samples: usize, is_off: impl Fn(usize) -> bool) -> Option<Self> {
        let first = (0..samples).find(|&sample| is_off(sample))?;
        let last = (0..samples).rev().find(|&sample| is_off(sample))?;
        Some(Self { first, end: last + 1 })
    }

    pub(super) fn samples(self) -> std::ops::Range<usize> {
        self.first..self.end
    }

    pub(super) fn len(self) -> usize {
        self.end - self.first
    }
}

/// A hypothesis with its best parameters.
#[derive(Debug, Clone)]
pub(super) struct FaultFit {
    pub(super) fault: RunFault,
    /// Relative residual: of the difference that the hypothesis explains.
    pub(super) remaining: f64,
    /// Number of fitted parameters.
    pub(super) parameters: i32,
}

impl FaultFit {
    /// Relative residual with a penalty for each parameter: smaller is better.
    pub(super) fn score(&self) -> f64 {
        // Below `NEGLIGIBLE` the residual is rounding: there only the number of parameters decides.
        self.remaining.max(NEGLIGIBLE) / COMPLEXITY_PER_PARAMETER.powi(self.parameters)
    }

    pub(super) fn explains(&self) -> bool {
        self.remaining <= EXPLAINED
    }
}

/// The best of the hypotheses that explain the difference.
pub(super) fn best(fits: impl IntoIterator<Item = FaultFit>) -> Option<FaultFit> {
    fits.into_iter().filter(FaultFit::explains).min_by(|a, b| a.score().total_cmp(&b.score()))
}

/// Root mean square; 0 without values.
pub(super) fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (count, sum) = values.fold((0.0, 0.0), |(count, sum), value| (count + 1.0, sum + value * value));
    if count > 0.0 { f64::sqrt(sum / count) } else { 0.0 }
}

/// The parameters `p` that bring `columns p` nearest to `values`.
#[derive(Debug)]
pub(super) struct Solution {
    pub(super) parameters: Vec<f64>,
    /// Relative residual of the values.
    pub(super) remaining: f64,
    /// Whether each parameter is identifiable by itself, and not only in a sum with others.
    pub(super) is_identifiable: Vec<bool>,
}

/// The parameters of columns, with singular directions at rounding level set to zero, and the relative residual.
pub(super) fn least_squares(columns: &[Vec<f64>], values: &[f64]) -> Option<(Vec<f64>, f64)> {
    const SINGULAR: f64 = 1e-9;
    let scales: Vec<f64> = columns.iter().map(|column| norm(column)).collect();
    let Solution { parameters, remaining, .. } = solve(columns, &scales, values, SINGULAR)?;
    Some((parameters, remaining))
}

/// The Euclidean norm, in the unit of the values.
pub(super) fn norm(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum::<f64>().sqrt()
}

/// The parameters of columns that are divided by `scales`. Directions of the parameters whose singular value is below the part
/// `singular` of the largest are set to zero.
pub(super) fn solve(columns: &[Vec<f64>], scales: &[f64], values: &[f64], singular: f64) -> Option<Solution> {
    /// A parameter with a smaller component in a direction that is set to zero does not depend on it. Kind: engineering.
    const PART_OF_DIRECTION: f64 = 0.05;
    let whole = rms(values.iter().copied());
    if values.is_empty() || whole <= 0.0 || scales.iter().any(|scale| !scale.is_finite() || *scale <= 0.0) {
        return None;
    }
    let scaled =
        columns.iter().zip(scales).map(|(column, scale)| DVector::from_column_slice(column) / *scale);
    let matrix = DMatrix::from_columns(&scaled.collect::<Vec<_>>());
    let values = DVector::from_column_slice(values);
    // By the singular value decomposition: columns of a short window are often nearly dependent, and the directions that the
    // values do not determine must be known, not only avoided.
    let svd = matrix.clone().svd(true, true);
    let smallest = singular * svd.singular_values.max();
    let solved = svd.solve(&values, smallest).ok()?;
    let directions = svd.v_t.as_ref()?;
    let is_identifiable = |parameter: usize| {
        let of_directions = directions.column(parameter);
        let mut each = of_directions.iter().zip(svd.singular_values.iter());
        each.all(|(part, value)| *value > smallest || part.abs() < PART_OF_DIRECTION)
    };
    let residual = &values - &matrix * &solved;
    Some(Solution {
        parameters: solved.iter().zip(scales).map(|(value, scale)| value / scale).collect(),
        remaining: rms(residual.iter().copied()) / whole,
        is_identifiable: (0..columns.len()).map(is_identifiable).collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parameter_without_effect_is_not_shown() {
        let column = |of: fn(f64) -> f64| (0..100).map(|at| of(f64::from(at) / 10.0)).collect::<Vec<f64>>();
        let nothing = column(|at| 1e-15 * (7.0 * at).sin());
        let columns = [column(f64::sin), column(f64::cos), nothing];
        let values: Vec<f64> = columns[0].iter().zip(&columns[1]).map(|(a, b)| 2.0 * a - 3.0 * b).collect();
        let scale = norm(&columns[0]);
        let solution = solve(&columns, &[scale; 3], &values, 1e-3).expect("they are independent");
        assert_eq!(solution.is_identifiable, [true, true, false]);
        assert!((solution.parameters[0] - 2.0).abs() < 1e-9 && (solution.parameters[1] + 3.0).abs() < 1e-9);
        assert!(solution.parameters[2].abs() < 1e-9 && solution.remaining < 1e-9);
        // Of two that have the same effect only the sum is shown.
        let twice = [columns[0].clone(), columns[0].clone(), columns[1].clone()];
        let solution = solve(&twice, &[scale; 3], &values, 1e-3).expect("a column is independent");
        assert_eq!(solution.is_identifiable, [false, false, true]);
    }
}
