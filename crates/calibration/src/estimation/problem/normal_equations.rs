//! The normal equations of a corrected chain on its measurements.

use congruent_kinematics::{Twist, hat, log_ratio};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::{
    configurations::configurations,
    measurement::{Measurement, PoseResidual},
    noise::Noise,
};
use crate::estimation::model::{ChainAt, CorrectedChain};

/// A correction has an effect on a measured component if it moves it by more than this, per unit of both.
/// Kind: rounding; a component that a correction does not change moves by 1e-15.
const HAS_EFFECT: f64 = 1e-9;

/// A corrected chain with its measurements.
#[derive(Debug, Clone, Copy)]
pub struct Problem<'a> {
    /// The chain with its free corrections.
    pub chain: &'a CorrectedChain,
    /// The measured poses or points, one for each row of the file.
    pub measurements: &'a [Measurement],
}

impl Problem<'_> {
    /// Residual of each measurement with corrections `p`.
    ///
    /// # Panics
    /// If `p` or a measurement's `q` has another length than the chain has parameters or joints.
    pub fn residuals(&self, p: &[f64]) -> Vec<PoseResidual> {
        let chain = self.chain.at(p);
        let residual = |each: &Measurement| each.residual(&chain.base_from_tip(&each.q));
        self.measurements.iter().map(residual).collect()
    }

    /// Number of measured components.
    pub fn component_count(&self) -> usize {
        self.measurements.iter().map(Measurement::component_count).sum()
    }

    /// Degrees of freedom to verify the corrections `kept` by: measured components on which one of them has an
    /// effect at the chain's start, less their number. Repetitions at one configuration count once.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::{Pose, ScrewChain, Twist};
    /// use congruent_calibration::estimation::{CorrectedChain, Measurement, Problem, zero_offsets};
    /// use nalgebra::{Matrix3, Vector3};
    /// let axis = Twist { angular: Vector3::z(), linear: Vector3::zeros() };
    /// let at_zero = Pose::from_parts(Matrix3::identity(), Vector3::x());
    /// let nominal = ScrewChain { twists_in_base: vec![axis], base_from_tip_at_zero: at_zero };
    /// let chain = CorrectedChain::new(nominal.clone(), zero_offsets(&nominal, &["joint"]));
    /// let at = |q: f64| Measurement {
    ///     q: [q].into(),
    ///     tip_in_base_m: [Some(0.0); 3],
    ///     base_from_tip: None,
    ///     camera_from_target: None,
    /// };
    /// // The zero has an effect on x and y but not on z, and the repetition adds nothing.
    /// let measurements = [at(0.3), at(0.9), at(0.3)];
    /// assert_eq!(Problem { chain: &chain, measurements: &measurements }.redundancy(&[0]), 3);
    /// ```
    ///
    /// # Panics
    /// If a measurement's `q` has another length than the chain has joints.
    pub fn redundancy(&self, kept: &[usize]) -> usize {
        let chain = self.chain.at(self.chain.start());
        let mut twists = vec![Twist::zero(); self.chain.parameters().len()];
        let configuration_of = configurations(self.measurements);
        let mut has_effect = vec![[false; 6]; configuration_of.iter().max().map_or(0, |last| last + 1)];
        for (measurement, &configuration) in self.measurements.iter().zip(&configuration_of) {
            let pose = chain.linearise(&measurement.q, &mut twists);
            let point = measurement.moved_point(&measurement.base_from_target(&pose));
            for twist in kept.iter().map(|&at| twists[at]) {
                // Velocity of what is measured under a unit rate of the correction: v + w x p, for a twist at the origin
                // of the base.
                let velocity = twist.linear + twist.angular.cross(&point);
                for at in 0..3 {
                    let is_measured = measurement.tip_in_base_m[at].is_some();
                    has_effect[configuration][at] |= is_measured && velocity[at].abs() > HAS_EFFECT;
                    let is_measured = measurement.base_from_tip.is_some();
                    // Components 0 to 2 are the position, 3 to 5 the orientation. A component counts once for
                    // each configuration, however often it was repeated.
                    has_effect[configuration][3 + at] |= is_measured && twist.angular[at].abs() > HAS_EFFECT;
                }
            }
        }
        // Fewer components than corrections is no redundancy rather than a negative one.
        has_effect.as_flattened().iter().filter(|&&has_effect| has_effect).count().saturating_sub(kept.len())
    }

    /// Largest distance of the nominal tip from the base over the measurements: the length of an angle of
    /// 1 rad if the two are to be compared.
    pub fn reach_m(&self) -> f64 {
        let chain = self.chain.at(&vec![0.0; self.chain.parameters().len()]);
        let distance = |each: &Measurement| chain.base_from_tip(&each.q).translation.norm();
        let reach = self.measurements.iter().map(distance).fold(0.0, f64::max);
        // All tips at the base, or no measurement: any positive length avoids dividing by zero.
        if reach > 0.0 { reach } else { 1.0 }
    }

    /// Sum of the squared residuals in units of the noise, each row with its weight.
    pub(in crate::estimation) fn cost(&self, p: &[f64], weighting: &Weighting) -> f64 {
        let chain = self.chain.at(p);
        let term = |(each, weight): (&Measurement, f64)| {
            weight * each.residual(&chain.base_from_tip(&each.q)).whitened_squared(&weighting.noise)
        };
        weighting.weighted(self.measurements).map(term).sum()
    }

    /// Normal equations at `p` for the corrections `kept`, the others held at their values.
    pub(in crate::estimation) fn normal_equations(
        &self,
        p: &[f64],
        kept: &[usize],
        weighting: &Weighting,
    ) -> CalibrationEquations {
        let mut linearisation = Linearisation::new(self.chain, p, kept);
        linearisation.equations(weighting.weighted(self.measurements), &weighting.noise)
    }
}

/// Weights of the residuals: noise of the components, and a weight for each row.
#[derive(Debug, Clone, Copy)]
pub(in crate::estimation) struct Weighting<'a> {
    pub(in crate::estimation) noise: Noise,
    /// Empty if all rows count 1.
    pub(in crate::estimation) rows: &'a [f64],
}

impl Weighting<'_> {
    /// The rows that count, each with its weight.
    fn weighted<'a>(&'a self, rows: &'a [Measurement]) -> impl Iterator<Item = (&'a Measurement, f64)> {
        let weight = |at: usize| self.rows.get(at).copied().unwrap_or(1.0);
        // A robust fit holds half of the rows out at weight 0.
        rows.iter().enumerate().map(move |(at, row)| (row, weight(at))).filter(|(_, weight)| *weight != 0.0)
    }
}

/// `J^T W J` and `J^T W r`, by position and by orientation, and `r^T W r`.
#[derive(Debug, Clone)]
pub(in crate::estimation) struct CalibrationEquations {
    pub(in crate::estimation) information: DMatrix<f64>,
    /// The part of the information that positions give.
    pub(in crate::estimation) by_position: DMatrix<f64>,
    pub(in crate::estimation) gradient: DVector<f64>,
    pub(in crate::estimation) cost: f64,
}

/// A chain at some corrections, with space for the Jacobian of one row there by some of them.
#[derive(Debug)]
pub(in crate::estimation) struct Linearisation<'a> {
    chain: ChainAt<'a>,
    kept: &'a [usize],
    twists: Vec<Twist>,
    /// The rates of the three coordinates of a position or of an orientation, for each correction.
    rates: Vec<Vector3<f64>>,
    row: Vec<f64>,
}

/// Part of the normal equations: the lower triangle of the information.
struct Sum {
    information: DMatrix<f64>,
    gradient: DVector<f64>,
}

impl<'a> Linearisation<'a> {
    pub(in crate::estimation) fn new(chain: &'a CorrectedChain, p: &[f64], kept: &'a [usize]) -> Self {
        let twists = vec![Twist::zero(); p.len()];
        let (rates, row) = (vec![Vector3::zeros(); kept.len()], vec![0.0; kept.len()]);
        Self { chain: chain.at(p), kept, twists, rates, row }
    }

    /// The equations of measurements with their weights.
    pub(in crate::estimation) fn equations<'m>(
        &mut self,
        rows: impl Iterator<Item = (&'m Measurement, f64)>,
        noise: &Noise,
    ) -> CalibrationEquations {
        // Kept apart, since the noise of positions and that of orientations are estimated from their own redundancies.
        let [mut by_position, mut by_orientation] = [(); 2].map(|()| Sum::zeros(self.kept.len()));
        let mut cost = 0.0;
        for (measurement, weight) in rows {
            let pose = self.chain.linearise(&measurement.q, &mut self.twists);
            let residual = measurement.residual(&pose);
            let point = measurement.moved_point(&measurement.base_from_target(&pose));
            cost += weight * residual.whitened_squared(noise);
            for (rate, &at) in self.rates.iter_mut().zip(self.kept) {
                let twist = &self.twists[at];
                *rate = twist.linear + twist.angular.cross(&point);
            }
            let factor = weight / noise.position_m.powi(2);
            // A coordinate that was not measured gives no row; a row with residual 0 would claim that it fits.
            for at in (0..3).filter(|&at| measurement.tip_in_base_m[at].is_some()) {
                self.fill_row(at);
                by_position.add(factor, &self.row, residual.position_m[at]);
            }
            if measurement.base_from_tip.is_some() {
                // The residual is a logarithm: its rate is not the angular velocity's if it is large.
                let rate_of_logarithm = log_rate_by_rotation(&residual.orientation_rad);
                for (rate, &at) in self.rates.iter_mut().zip(self.kept) {
                    *rate = rate_of_logarithm * self.twists[at].angular;
                }
                let factor = weight / noise.orientation_rad.powi(2);
                for at in 0..3 {
                    self.fill_row(at);
                    by_orientation.add(factor, &self.row, residual.orientation_rad[at]);
                }
            }
        }
        let gradient = by_position.gradient + by_orientation.gradient;
        let [by_position, by_orientation] =
            [by_position.information, by_orientation.information].map(symmetric);
        CalibrationEquations { information: &by_position + by_orientation, by_position, gradient, cost }
    }

    fn fill_row(&mut self, coordinate: usize) {
        self.row.iter_mut().zip(&self.rates).for_each(|(entry, rate)| *entry = rate[coordinate]);
    }
}

impl Sum {
    fn zeros(corrections: usize) -> Self {
        Self { information: DMatrix::zeros(corrections, corrections), gradient: DVector::zeros(corrections) }
    }

    /// Adds one component: its row of the Jacobian, its residual and the factor of both.
    fn add(&mut self, factor: f64, row: &[f64], residual: f64) {
        let columns = self.information.as_mut_slice().chunks_exact_mut(row.len().max(1));
        // The matrix is symmetric and stored by columns: of each only what is below the diagonal.
        for (at, column) in columns.enumerate() {
            let by = factor * row[at];
            column[at..].iter_mut().zip(&row[at..]).for_each(|(entry, other)| *entry += by * other);
        }
        for (entry, rate) in self.gradient.iter_mut().zip(row) {
            *entry += factor * residual * rate;
        }
    }
}

/// The symmetric matrix with this lower triangle.
fn symmetric(mut lower: DMatrix<f64>) -> DMatrix<f64> {
    lower.fill_upper_triangle_with_lower_triangle();
    lower
}

/// Rate of the logarithm `e` of an orientation residual by a rotation of the model: the inverse of
/// the right Jacobian, `I + [e]/2 + (1/t^2 - cot(t/2)/(2 t)) [e]^2`.
///
/// Source: Chirikjian, *Stochastic Models, Information Theory, and Lie Groups*, vol. 2 (2012), eq. 10.86.
fn log_rate_by_rotation(e: &Vector3<f64>) -> Matrix3<f64> {
    let skew = hat(e);
    Matrix3::identity() + skew / 2.0 + skew * skew * log_ratio(e.norm())
}
