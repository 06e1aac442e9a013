//! The distribution of the error to first order: covariances at configurations, and quantiles as if the sum of the errors were
//! normal.

use congruent_description::{RobotQ, RobotQList};
use congruent_kinematics::Twist;
use nalgebra::Matrix3;
use schemars::JsonSchema;
use serde::Serialize;

use crate::{
    error_chain::ErrorMotions,
    norm_quantile::{NormDistribution, PrincipalVariances},
    parameters::ToleratedChain,
};

/// Errors of the tool to first order.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct FirstOrderError {
    /// Root mean square of the distance, m.
    pub rms_m: f64,
    /// Distance that is not exceeded with 95 % probability, if the sum of the errors is normal, m.
    pub p95_m: f64,
    /// Distance that is not exceeded with 99.7 % probability, if the sum of the errors is normal, m.
    pub p997_m: f64,
    /// Root mean square of the angle, rad.
    pub rms_rad: f64,
    /// Angle that is not exceeded with 95 % probability, if the sum of the errors is normal, rad.
    pub p95_rad: f64,
    /// Angle that is not exceeded with 99.7 % probability, if the sum of the errors is normal, rad.
    pub p997_rad: f64,
}

/// The columns of the parameters at each configuration, each for one standard deviation.
#[derive(Debug, Clone)]
pub(crate) struct ScaledColumns {
    /// One list for each configuration.
    pub(crate) at: Vec<Vec<Twist>>,
}

impl ScaledColumns {
    pub(crate) fn new(tolerated: &ToleratedChain, configurations: &RobotQList) -> Self {
        let mut motions = ErrorMotions::default();
        let columns = |q: RobotQ| columns_at(tolerated, &q, &mut motions);
        Self { at: configurations.iter().map(columns).collect() }
    }

    /// Every k-th configuration, so that at most `most` remain.
    pub(crate) fn thinned(&self, most: usize) -> Self {
        let step = self.at.len().div_ceil(most).max(1);
        Self { at: self.at.iter().step_by(step).cloned().collect() }
    }

    /// The same with the standard deviation of each parameter multiplied.
    pub(crate) fn scaled(&self, factors: &[f64]) -> Self {
        let scaled = |columns: &Vec<Twist>| {
            columns.iter().zip(factors).map(|(column, &factor)| *column * factor).collect()
        };
        Self { at: self.at.iter().map(scaled).collect() }
    }

    /// The errors over all configurations, each as likely as the others.
    pub(crate) fn errors(&self, tolerated: &ToleratedChain, norm: &NormDistribution) -> FirstOrderError {
        let covariances: Vec<_> =
            self.at.iter().map(|columns| tolerated.spread.covariances(columns)).collect();
        let of = |part: usize| -> Vec<PrincipalVariances> {
            covariances.iter().map(|both| PrincipalVariances::new(&both[part])).collect()
        };
        let [positions, orientations] = [of(0), of(1)];
        FirstOrderError {
            rms_m: rms(&positions),
            p95_m: norm.quantile(&positions, 0.95),
            p997_m: norm.quantile(&positions, 0.997),
            rms_rad: rms(&orientations),
            p95_rad: norm.quantile(&orientations, 0.95),
            p997_rad: norm.quantile(&orientations, 0.997),
        }
    }

    /// The variances of the position at each configuration.
    pub(crate) fn position_variances(&self, tolerated: &ToleratedChain) -> Vec<PrincipalVariances> {
        let at = |columns: &Vec<Twist>| PrincipalVariances::new(&tolerated.spread.covariances(columns)[0]);
        self.at.iter().map(at).collect()
    }

    /// Part of each parameter in the mean square of the distance, m^2.
    pub(crate) fn parts_m2(&self, tolerated: &ToleratedChain) -> Vec<f64> {
        let mut parts = vec![0.0; tolerated.parameters.len()];
        for columns in &self.at {
            tolerated.spread.add_parts(columns, &mut parts);
        }
        #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^52 configurations")]
        let count = self.at.len().max(1) as f64;
        for part in &mut parts {
            *part /= count;
        }
        parts
    }
}

/// Root mean square of the length of a mixture.
fn rms(parts: &[PrincipalVariances]) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^52 configurations")]
    let count = parts.len().max(1) as f64;
    (parts.iter().map(|PrincipalVariances(s)| s.iter().sum::<f64>()).sum::<f64>() / count).sqrt()
}

/// The columns at a configuration, for one standard deviation of each parameter.
pub(crate) fn columns_at(tolerated: &ToleratedChain, q: &RobotQ, motions: &mut ErrorMotions) -> Vec<Twist> {
    let mut columns = Vec::new();
    tolerated.chain.motions_into(q, motions);
    motions.columns_into(&tolerated.spread.deviations, &mut columns);
    columns
}

/// Covariances of the position and of the orientation at a configuration; in buffers of its own.
#[derive(Debug)]
pub(crate) struct ErrorCovariances<'a> {
    tolerated: &'a ToleratedChain,
    motions: ErrorMotions,
    columns: Vec<Twist>,
}

impl<'a> ErrorCovariances<'a> {
    pub(crate) fn new(tolerated: &'a ToleratedChain) -> Self {
        Self { tolerated, motions: ErrorMotions::default(), columns: Vec::new() }
    }

    /// Of the position, m^2, and of the orientation, rad^2.
    pub(crate) fn at(&mut self, q: &RobotQ) -> [Matrix3<f64>; 2] {
        self.tolerated.chain.motions_into(q, &mut self.motions);
        self.motions.columns_into(&self.tolerated.spread.deviations, &mut self.columns);
        self.tolerated.spread.covariances(&self.columns)
    }

    /// The tool without errors, in the base, at the configuration of the last call.
    pub(crate) fn tcp_in_base(&self) -> nalgebra::Vector3<f64> {
        self.motions.tcp_in_base
    }
}
