//! Measured against modelled: residuals, and the normal equations that they sum up to.

use congruent_description::ChainQ;
use congruent_kinematics::{Pose, Twist, hat, log_ratio, rotation_log};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::{configurations::configurations, model::CorrectedChain, noise::Noise};

/// A correction that moves a measured component by less, per unit of both, does not show in it. Kind:
/// rounding; what a correction leaves alone moves by 1e-15.
const SHOWS: f64 = 1e-9;

/// What was measured at one configuration.
///
/// | field | shape | unit | frame |
/// |---|---|---|---|
/// | `q` | n | rad, m | joints of the chain |
/// | `tip_in_base_m` | 3 | m | base; `None` for a coordinate that was not measured |
/// | `base_from_tip` | 3 x 3 | 1 | orientation, where it was measured |
#[derive(Debug, Clone, PartialEq)]
pub struct Measurement {
    /// Joint positions as the robot reported them.
    pub q: ChainQ,
    /// Measured position of the tip.
    pub tip_in_base_m: [Option<f64>; 3],
    /// Measured orientation of the tip.
    pub base_from_tip: Option<Matrix3<f64>>,
}

impl Measurement {
    /// Number of measured coordinates of the position.
    pub fn position_count(&self) -> usize {
        self.tip_in_base_m.iter().flatten().count()
    }

    /// Number of measured components of the orientation.
    pub fn orientation_count(&self) -> usize {
        if self.base_from_tip.is_some() { 3 } else { 0 }
    }

    /// Measured minus modelled.
    pub fn residual(&self, base_from_tip: &Pose) -> Residual {
        let along = |at: usize| {
            self.tip_in_base_m[at].map_or(0.0, |measured| measured - base_from_tip.translation[at])
        };
        let orientation_rad = self.base_from_tip.map_or(Vector3::zeros(), |measured| {
            rotation_log(&(measured * base_from_tip.rotation.transpose()))
        });
        Residual { position_m: Vector3::new(along(0), along(1), along(2)), orientation_rad }
    }
}

/// Measured minus modelled, in the base; 0 where nothing was measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Residual {
    /// Difference of the positions.
    pub position_m: Vector3<f64>,
    /// The turn from the modelled to the measured orientation, axis times angle.
    pub orientation_rad: Vector3<f64>,
}

impl Residual {
    /// Squared norm in units of the noise.
    pub(super) fn whitened_squared(&self, noise: &Noise) -> f64 {
        self.position_m.norm_squared() / noise.position_m.powi(2)
            + self.orientation_rad.norm_squared() / noise.orientation_rad.powi(2)
    }
}

/// A chain and what was measured of it.
#[derive(Debug, Clone, Copy)]
pub struct Problem<'a> {
    /// The chain with its free corrections.
    pub chain: &'a CorrectedChain,
    /// The measurements.
    pub measurements: &'a [Measurement],
}

impl Problem<'_> {
    /// Residual of each measurement with corrections `p`.
    ///
    /// # Panics
    /// When `p` or a measurement's `q` has another length than the chain asks for.
    pub fn residuals(&self, p: &[f64]) -> Vec<Residual> {
        let residual = |each: &Measurement| each.residual(&self.chain.base_from_tip(&each.q, p));
        self.measurements.iter().map(residual).collect()
    }

    /// Number of measured components.
    pub fn component_count(&self) -> usize {
        self.measurements.iter().map(|each| each.position_count() + each.orientation_count()).sum()
    }

    /// Measured components in which one of the corrections `kept` shows at nominal, less the number of these
    /// corrections: what is left to judge them by. Repetitions at one configuration count once.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::{Pose, ScrewChain, Twist};
    /// use crate::estimation::{CorrectedChain, Measurement, Problem, zero_offsets};
    /// use nalgebra::{Matrix3, Vector3};
    /// let turn = Twist { angular: Vector3::z(), linear: Vector3::zeros() };
    /// let at_zero = Pose::from_parts(Matrix3::identity(), Vector3::x());
    /// let nominal = ScrewChain { twists_in_base: vec![turn], base_from_tip_at_zero: at_zero };
    /// let chain = CorrectedChain::new(nominal.clone(), zero_offsets(&nominal, &["joint"]));
    /// let at = |q: f64| Measurement { q: vec![q], tip_in_base_m: [Some(0.0); 3], base_from_tip: None };
    /// // The zero shows in x and y but not in z, and the repetition says nothing new.
    /// let measurements = [at(0.3), at(0.9), at(0.3)];
    /// assert_eq!(Problem { chain: &chain, measurements: &measurements }.redundancy(&[0]), 3);
    /// ```
    ///
    /// # Panics
    /// When a measurement's `q` has another length than the chain has joints.
    pub fn redundancy(&self, kept: &[usize]) -> usize {
        let none = vec![0.0; self.chain.parameters().len()];
        let mut twists = vec![Twist::zero(); none.len()];
        let configuration_of = configurations(self.measurements);
        let mut seen = vec![[false; 6]; configuration_of.iter().max().map_or(0, |last| last + 1)];
        for (measurement, &configuration) in self.measurements.iter().zip(&configuration_of) {
            let pose = self.chain.linearise(&measurement.q, &none, &mut twists);
            for twist in kept.iter().map(|&at| twists[at]) {
                let velocity = twist.linear + twist.angular.cross(&pose.translation);
                for at in 0..3 {
                    let is_measured = measurement.tip_in_base_m[at].is_some();
                    seen[configuration][at] |= is_measured && velocity[at].abs() > SHOWS;
                    let is_measured = measurement.base_from_tip.is_some();
                    seen[configuration][3 + at] |= is_measured && twist.angular[at].abs() > SHOWS;
                }
            }
        }
        seen.as_flattened().iter().filter(|&&seen| seen).count().saturating_sub(kept.len())
    }

    /// Largest distance of the nominal tip from the base over the measurements: what turns an angle
    /// into a length where the two are to be compared.
    pub fn reach_m(&self) -> f64 {
        let none = vec![0.0; self.chain.parameters().len()];
        let distance = |each: &Measurement| self.chain.base_from_tip(&each.q, &none).translation.norm();
        let reach = self.measurements.iter().map(distance).fold(0.0, f64::max);
        if reach > 0.0 { reach } else { 1.0 }
    }

    /// Sum of the squared residuals in units of the noise, each row with its weight.
    pub(super) fn cost(&self, p: &[f64], weighting: &Weighting) -> f64 {
        let term = |(at, each): (usize, &Measurement)| {
            let residual = each.residual(&self.chain.base_from_tip(&each.q, p));
            weighting.of_row(at) * residual.whitened_squared(&weighting.noise)
        };
        self.measurements.iter().enumerate().map(term).sum()
    }

    /// Normal equations for all corrections at `p`.
    pub(super) fn normal_equations(&self, p: &[f64], weighting: &Weighting) -> NormalEquations {
        let mut sum = NormalEquations::zeros(p.len());
        let mut at_p = Linearisation::new(self.chain, p);
        for (at, measurement) in self.measurements.iter().enumerate() {
            sum.add(&mut at_p, measurement, (weighting.of_row(at), &weighting.noise));
        }
        sum
    }
}

/// What a residual counts: noise of the components, and a weight for each row.
#[derive(Debug, Clone, Copy)]
pub(super) struct Weighting<'a> {
    pub(super) noise: Noise,
    /// Empty where all rows count 1.
    pub(super) rows: &'a [f64],
}

impl Weighting<'_> {
    fn of_row(&self, at: usize) -> f64 {
        self.rows.get(at).copied().unwrap_or(1.0)
    }
}

/// `J^T W J` and `J^T W r`, by position and by orientation, and `r^T W r`.
#[derive(Debug, Clone)]
pub(super) struct NormalEquations {
    pub(super) information: DMatrix<f64>,
    /// The part of the information that positions give.
    pub(super) by_position: DMatrix<f64>,
    pub(super) gradient: DVector<f64>,
    pub(super) cost: f64,
}

/// A chain at some corrections, with room for one row of the Jacobian there.
#[derive(Debug)]
pub(super) struct Linearisation<'a> {
    chain: &'a CorrectedChain,
    p: &'a [f64],
    twists: Vec<Twist>,
    row: DVector<f64>,
}

impl<'a> Linearisation<'a> {
    pub(super) fn new(chain: &'a CorrectedChain, p: &'a [f64]) -> Self {
        Self { chain, p, twists: vec![Twist::zero(); p.len()], row: DVector::zeros(p.len()) }
    }
}

impl NormalEquations {
    pub(super) fn zeros(parameters: usize) -> Self {
        Self {
            information: DMatrix::zeros(parameters, parameters),
            by_position: DMatrix::zeros(parameters, parameters),
            gradient: DVector::zeros(parameters),
            cost: 0.0,
        }
    }

    /// Adds one measurement with its weight and noise.
    pub(super) fn add(
        &mut self,
        at_p: &mut Linearisation<'_>,
        measurement: &Measurement,
        (weight, noise): (f64, &Noise),
    ) {
        let Linearisation { chain, p, twists, row } = at_p;
        let pose = chain.linearise(&measurement.q, p, twists);
        let residual = measurement.residual(&pose);
        self.cost += weight * residual.whitened_squared(noise);
        for at in (0..3).filter(|&at| measurement.tip_in_base_m[at].is_some()) {
            for (entry, twist) in row.iter_mut().zip(twists.iter()) {
                let velocity = twist.linear + twist.angular.cross(&pose.translation);
                *entry = velocity[at];
            }
            let factor = weight / noise.position_m.powi(2);
            self.by_position.ger(factor, row, row, 1.0);
            self.gradient.axpy(factor * residual.position_m[at], row, 1.0);
            self.information.ger(factor, row, row, 1.0);
        }
        if measurement.base_from_tip.is_some() {
            // The residual is a logarithm: its rate is not the turn's where it is large.
            let rate = log_rate_from_turn(&residual.orientation_rad);
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

    /// The equations of some corrections alone, the others held where they are.
    pub(super) fn only(&self, kept: &[usize]) -> Self {
        Self {
            information: self.information.select_rows(kept).select_columns(kept),
            by_position: self.by_position.select_rows(kept).select_columns(kept),
            gradient: self.gradient.select_rows(kept),
            cost: self.cost,
        }
    }
}

/// How fast the logarithm `e` of an orientation residual falls per turn of the model: the inverse of
/// the right Jacobian, `I + [e]/2 + (1/t^2 - cot(t/2)/(2 t)) [e]^2`.
///
/// Source: Chirikjian, *Stochastic Models, Information Theory, and Lie Groups*, vol. 2 (2012), eq. 10.86.
fn log_rate_from_turn(e: &Vector3<f64>) -> Matrix3<f64> {
    let skew = hat(e);
    Matrix3::identity() + skew / 2.0 + skew * skew * log_ratio(e.norm())
}
