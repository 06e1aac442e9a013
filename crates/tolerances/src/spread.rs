//! The joint distribution of all errors: standard deviations, limits, and their correlation.

use congruent_description::ErrorDistribution;
use congruent_kinematics::{Twist, Uniform};
use nalgebra::{DMatrix, Matrix3, SymmetricEigen, Vector3};

/// How the errors of all parameters are distributed together.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ErrorSpread {
    /// Half width of each parameter, rad or m.
    pub(crate) tolerances: Vec<f64>,
    /// Standard deviation of each, rad or m.
    pub(crate) deviations: Vec<f64>,
    /// How each error is distributed.
    pub(crate) distribution: ErrorDistribution,
    /// Factor R of the correlations `R R'`; `None` if the errors are independent.
    pub(crate) correlation: Option<DMatrix<f64>>,
}

impl ErrorSpread {
    /// Independent errors.
    pub(crate) fn independent(tolerances: Vec<f64>, distribution: ErrorDistribution) -> Self {
        let deviations = tolerances.iter().map(|&each| distribution.standard_deviation(each)).collect();
        Self { tolerances, deviations, distribution, correlation: None }
    }

    /// Normal errors with this covariance; the tolerance of each is `sigmas` standard deviations.
    pub(crate) fn of_covariance(covariance: &DMatrix<f64>, sigmas: f64) -> Self {
        let deviations: Vec<f64> = covariance.diagonal().iter().map(|each| each.max(0.0).sqrt()).collect();
        let correlation = DMatrix::from_fn(deviations.len(), deviations.len(), |row, column| {
            let scale = deviations[row] * deviations[column];
            if scale > 0.0 { covariance[(row, column)] / scale } else { 0.0 }
        });
        // By eigenvalues and not by Cholesky: a covariance with a direction that does not vary is singular.
        let eigen = SymmetricEigen::new(correlation);
        let mut factor = eigen.eigenvectors;
        for (mut column, value) in factor.column_iter_mut().zip(eigen.eigenvalues.iter()) {
            column *= value.max(0.0).sqrt();
        }
        Self {
            tolerances: deviations.iter().map(|each| each * sigmas).collect(),
            deviations,
            distribution: ErrorDistribution::Normal { sigmas },
            correlation: Some(factor),
        }
    }

    /// Standard deviations of a tolerance; `None` of uniform errors.
    pub(crate) fn sigmas(&self) -> Option<f64> {
        match self.distribution {
            ErrorDistribution::Uniform => None,
            ErrorDistribution::Normal { sigmas } => Some(sigmas),
        }
    }

    /// Number of parameters.
    pub(crate) fn count(&self) -> usize {
        self.deviations.len()
    }

    /// Covariance of the position and of the orientation from columns that are scaled by the standard deviations.
    pub(crate) fn covariances(&self, columns: &[Twist]) -> [Matrix3<f64>; 2] {
        let mut sums = [Matrix3::zeros(); 2];
        let mut add = |column: &Twist| {
            sums[0] += column.linear * column.linear.transpose();
            sums[1] += column.angular * column.angular.transpose();
        };
        match &self.correlation {
            None => columns.iter().for_each(add),
            // J S J' = (J D R)(J D R)'.
            Some(factor) => factor.column_iter().for_each(|direction| {
                let sum = |sum: Twist, (column, &part): (&Twist, &f64)| sum + *column * part;
                add(&columns.iter().zip(direction.iter()).fold(Twist::zero(), sum));
            }),
        }
        sums
    }

    /// Part of each parameter in the variance of the position: they add up to it. A part is negative if the error of the parameter
    /// is correlated with those of others and reduces theirs.
    pub(crate) fn add_parts(&self, columns: &[Twist], parts: &mut [f64]) {
        match &self.correlation {
            None => {
                for (part, column) in parts.iter_mut().zip(columns) {
                    *part += column.linear.norm_squared();
                }
            }
            Some(factor) => {
                for direction in factor.column_iter() {
                    let sum = |sum: Vector3<f64>, (column, &part): (&Twist, &f64)| sum + column.linear * part;
                    let total = columns.iter().zip(direction.iter()).fold(Vector3::zeros(), sum);
                    for ((part, column), &weight) in parts.iter_mut().zip(columns).zip(direction.iter()) {
                        *part += (column.linear * weight).dot(&total);
                    }
                }
            }
        }
    }
}

/// Draws the errors of all parameters.
#[derive(Debug)]
pub(crate) struct ErrorDraws<'a> {
    spread: &'a ErrorSpread,
    random: Uniform,
    /// Standard normal numbers, if the errors are correlated.
    independent: Vec<f64>,
}

impl<'a> ErrorDraws<'a> {
    /// The same numbers for the same seed.
    pub(crate) fn new(spread: &'a ErrorSpread, seed: u64) -> Self {
        Self { spread, random: Uniform::seeded(seed), independent: vec![0.0; spread.count()] }
    }

    /// Draws into `errors`, rad and m; nothing is allocated.
    pub(crate) fn draw(&mut self, errors: &mut [f64]) {
        let spread = self.spread;
        if let Some(factor) = &spread.correlation {
            let random = &mut self.random;
            self.independent.iter_mut().for_each(|each| *each = normal(random));
            for (at, error) in errors.iter_mut().enumerate() {
                let row = factor.row(at);
                let sum: f64 = row.iter().zip(&self.independent).map(|(part, each)| part * each).sum();
                *error = spread.deviations[at] * sum;
            }
            return;
        }
        for (at, error) in errors.iter_mut().enumerate() {
            *error = match spread.distribution {
                ErrorDistribution::Uniform => self.random.between(-1.0, 1.0) * spread.tolerances[at],
                ErrorDistribution::Normal { .. } => normal(&mut self.random) * spread.deviations[at],
            };
        }
    }
}

/// A standard normal number.
///
/// Source: Box & Muller, *A note on the generation of random normal deviates* (1958).
fn normal(random: &mut Uniform) -> f64 {
    // In (0, 1]: the logarithm of 0 would be infinite.
    let share = 1.0 - random.between(0.0, 1.0);
    let turn = random.between(0.0, std::f64::consts::TAU);
    (-2.0 * libm::log(share)).sqrt() * libm::cos(turn)
}
