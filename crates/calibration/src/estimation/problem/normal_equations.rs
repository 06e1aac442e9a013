//! The normal equations of a corrected chain on its measurements.

use congruent_kinematics::{Twist, hat, log_ratio};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::{
    configurations::configurations,
    measurement::{Measurement, PoseResidual},
    noise::Noise,
};
use crate::estimation::model::CorrectedChain;

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
        let residual = |each: &Measurement| each.residual(&self.chain.base_from_tip(&each.q, p));
        self.measurements.iter().map(residual).collect()
    }

    /// Number of measured components.
    pub fn component_count(&self) -> usize {
        self.measurements.iter().map(Measurement::component_count).sum()
    }

    /// Degrees of freedom to verify the corrections `kept` by: measured components on which one of them has an
    /// effect at nominal, less their number. Repetitions at one configuration count once.
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
    /// let at = |q: f64| Measurement { q: [q].into(), tip_in_base_m: [Some(0.0); 3], base_from_tip: None };
    /// // The zero has an effect on x and y but not on z, and the repetition adds nothing.
    /// let measurements = [at(0.3), at(0.9), at(0.3)];
    /// assert_eq!(Problem { chain: &chain, measurements: &measurements }.redundancy(&[0]), 3);
    /// ```
    ///
    /// # Panics
    /// If a measurement's `q` has another length than the chain has joints.
    pub fn redundancy(&self, kept: &[usize]) -> usize {
        let none = vec![0.0; self.chain.parameters().len()];
        let mut twists = vec![Twist::zero(); none.len()];
        let configuration_of = configurations(self.measurements);
        let mut has_effect = vec![[false; 6]; configuration_of.iter().max().map_or(0, |last| last + 1)];
        for (measurement, &configuration) in self.measurements.iter().zip(&configuration_of) {
            let pose = self.chain.linearise(&measurement.q, &none, &mut twists);
            for twist in kept.iter().map(|&at| twists[at]) {
                // Velocity of the tip under a unit rate of the correction: v + w x p, for a twist at the origin
                // of the base.
                let velocity = twist.linear + twist.angular.cross(&pose.translation);
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
        let none = vec![0.0; self.chain.parameters().len()];
        let distance = |each: &Measurement| self.chain.base_from_tip(&each.q, &none).translation.norm();
        let reach = self.measurements.iter().map(distance).fold(0.0, f64::max);
        // All tips at the base, or no measurement: any positive length avoids dividing by zero.
        if reach > 0.0 { reach } else { 1.0 }
    }

    /// Sum of the squared residuals in units of the noise, each row with its weight.
    pub(in crate::estimation) fn cost(&self, p: &[f64], weighting: &Weighting) -> f64 {
        let term = |(at, each): (usize, &Measurement)| {
            let residual = each.residual(&self.chain.base_from_tip(&each.q, p));
            weighting.row_weight(at) * residual.whitened_squared(&weighting.noise)
        };
        self.measurements.iter().enumerate().map(term).sum()
    }

    /// Normal equations for all corrections at `p`.
    pub(in crate::estimation) fn normal_equations(
        &self,
        p: &[f64],
        weighting: &Weighting,
    ) -> CalibrationEquations {
        let mut sum = CalibrationEquations::zeros(p.len());
        let mut at_p = Linearisation::new(self.chain, p);
        for (at, measurement) in self.measurements.iter().enumerate() {
            sum.add(&mut at_p, measurement, weighting.row_weight(at), &weighting.noise);
        }
        sum
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
    fn row_weight(&self, at: usize) -> f64 {
        self.rows.get(at).copied().unwrap_or(1.0)
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

/// A chain at some corrections, with space for one row of the Jacobian there.
#[derive(Debug)]
pub(in crate::estimation) struct Linearisation<'a> {
    chain: &'a CorrectedChain,
    p: &'a [f64],
    twists: Vec<Twist>,
    row: DVector<f64>,
}

impl<'a> Linearisation<'a> {
    pub(in crate::estimation) fn new(chain: &'a CorrectedChain, p: &'a [f64]) -> Self {
        Self { chain, p, twists: vec![Twist::zero(); p.len()], row: DVector::zeros(p.len()) }
    }
}

impl CalibrationEquations {
    pub(in crate::estimation) fn zeros(parameters: usize) -> Self {
        Self {
            information: DMatrix::zeros(parameters, parameters),
            by_position: DMatrix::zeros(parameters, parameters),
            gradient: DVector::zeros(parameters),
            cost: 0.0,
        }
    }

    /// Adds one measurement with its weight and noise.
    pub(in crate::estimation) fn add(
        &mut self,
        at_p: &mut Linearisation<'_>,
        measurement: &Measurement,
        weight: f64,
        noise: &Noise,
    ) {
        let Linearisation { chain, p, twists, row } = at_p;
        let pose = chain.linearise(&measurement.q, p, twists);
        let residual = measurement.residual(&pose);
        self.cost += weight * residual.whitened_squared(noise);
        // A coordinate that was not measured gives no row; a row with residual 0 would claim that it fits.
        for at in (0..3).filter(|&at| measurement.tip_in_base_m[at].is_some()) {
            for (entry, twist) in row.iter_mut().zip(twists.iter()) {
                let velocity = twist.linear + twist.angular.cross(&pose.translation);
                *entry = velocity[at];
            }
            let factor = weight / noise.position_m.powi(2);
            // Kept apart, since the noise of positions and that of orientations are estimated from their own
            // redundancies.
            self.by_position.ger(factor, row, row, 1.0);
            self.gradient.axpy(factor * residual.position_m[at], row, 1.0);
            self.information.ger(factor, row, row, 1.0);
        }
        if measurement.base_from_tip.is_some() {
            // The residual is a logarithm: its rate is not the angular velocity's if it is large.
            let rate = log_rate_by_rotation(&residual.orientation_rad);
            for component in 0..3 {
                for (entry, twist) in row.iter_mut().zip(twists.iter()) {
                    *entry = rate.row(component).transpose().dot(&twist.angular);
                }
                let factor = weight / noise.orientation_rad.powi(2);
                self.gradient.axpy(factor * residual.orientation_rad[component], row, 1.0);
                self.information.ger(factor, row, row, 1.0);
            }
        }
    }

    /// The equations of some corrections alone, the others held at their current values.
    pub(in crate::estimation) fn only(&self, kept: &[usize]) -> Self {
        Self {
            information: self.information.select_rows(kept).select_columns(kept),
            by_position: self.by_position.select_rows(kept).select_columns(kept),
            gradient: self.gradient.select_rows(kept),
            cost: self.cost,
        }
    }
}

/// Rate of the logarithm `e` of an orientation residual by a rotation of the model: the inverse of
/// the right Jacobian, `I + [e]/2 + (1/t^2 - cot(t/2)/(2 t)) [e]^2`.
///
/// Source: Chirikjian, *Stochastic Models, Information Theory, and Lie Groups*, vol. 2 (2012), eq. 10.86.
fn log_rate_by_rotation(e: &Vector3<f64>) -> Matrix3<f64> {
    let skew = hat(e);
    Matrix3::identity() + skew / 2.0 + skew * skew * log_ratio(e.norm())
}
