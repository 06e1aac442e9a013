//! How hypotheses are fitted and compared.

use nalgebra::{DMatrix, DVector};

use crate::fault::RunFault;

/// What a hypothesis may leave of the difference that it explains, as a part of it. Kind: ratio of root mean squares. A right
/// hypothesis leaves what engine and inverse dynamics differ by in a step, some hundredths of a small fault; a constant leaves
/// half of a line, and a line half of a sine.
pub(super) const EXPLAINED: f64 = 0.1;
/// Each parameter of a hypothesis must lower what it leaves to this part: less is what any parameter would take.
const PRICE_OF_PARAMETER: f64 = 1.0 / 3.0;
/// Parts below this are not told apart.
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
    pub(super) fn of(samples: usize, is_off: impl Fn(usize) -> bool) -> Option<Self> {
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
pub(super) struct Fit {
    pub(super) fault: RunFault,
    /// What it leaves of the difference, as a part of it.
    pub(super) remaining: f64,
    pub(super) parameters: i32,
}

impl Fit {
    /// Smaller is better.
    pub(super) fn score(&self) -> f64 {
        self.remaining.max(NEGLIGIBLE) / PRICE_OF_PARAMETER.powi(self.parameters)
    }

    pub(super) fn explains(&self) -> bool {
        self.remaining <= EXPLAINED
    }
}

/// The best of the hypotheses that explain the difference.
pub(super) fn best(fits: impl IntoIterator<Item = Fit>) -> Option<Fit> {
    fits.into_iter().filter(Fit::explains).min_by(|a, b| a.score().total_cmp(&b.score()))
}

/// Root mean square.
pub(super) fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (count, sum) = values.fold((0.0, 0.0), |(count, sum), value| (count + 1.0, sum + value * value));
    if count > 0.0 { f64::sqrt(sum / count) } else { 0.0 }
}

/// The parameters `p` that bring `columns p` nearest to `values`, and what they leave of it, as a part.
pub(super) fn least_squares(columns: &[Vec<f64>], values: &[f64]) -> Option<(Vec<f64>, f64)> {
    /// Directions of the parameters that change nothing are left at zero.
    const SINGULAR: f64 = 1e-9;
    let whole = rms(values.iter().copied());
    if values.is_empty() || whole <= 0.0 {
        return None;
    }
    let columns: Vec<DVector<f64>> =
        columns.iter().map(|column| DVector::from_column_slice(column)).collect();
    let scales: Vec<f64> = columns.iter().map(DVector::norm).collect();
    if scales.iter().any(|scale| !scale.is_finite() || *scale <= 0.0) {
        return None;
    }
    let scaled: Vec<DVector<f64>> =
        columns.iter().zip(&scales).map(|(column, scale)| column / *scale).collect();
    let matrix = DMatrix::from_columns(&scaled);
    let values = DVector::from_column_slice(values);
    let solved = matrix.clone().svd(true, true).solve(&values, SINGULAR).ok()?;
    let left = &values - &matrix * &solved;
    let parameters = solved.iter().zip(&scales).map(|(value, scale)| value / scale).collect();
    Some((parameters, rms(left.iter().copied()) / whole))
}
