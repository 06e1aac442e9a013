//! The cost as a function of one correction, for the figure of a calibration.

use super::{
    estimate::CalibrationFit,
    problem::{Problem, median_norm},
    robust::{RobustFit, distance},
};

/// The cost at one value of a correction, the others as estimated.
///
/// | field | unit | meaning |
/// |---|---|---|
/// | `value` | rad, m | of the correction |
/// | `least_squares_m2` | m2 | squared residuals; those of orientations weighted by the noise |
/// | `robust_m2` | m2 | the same through the robust loss, equal to it if residuals are small |
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CostPoint {
    /// Value of the correction.
    pub value: f64,
    /// Cost by least squares, the other corrections as estimated by least squares.
    pub least_squares_m2: f64,
    /// Cost by the robust loss, the other corrections as estimated robustly.
    pub robust_m2: f64,
}

/// The cost over the values of one correction.
///
/// # Panics
/// If the chain has no correction of this index.
pub fn cost_curve(
    problem: &Problem<'_>,
    plain: &CalibrationFit,
    robust: &RobustFit,
    parameter: usize,
    values: impl Iterator<Item = f64>,
) -> Vec<CostPoint> {
    let (mut plain_p, mut robust_p) = (plain.corrections.clone(), robust.fit.corrections.clone());
    let noise = robust.scale;
    // The others stay as estimated: the curve is a section of the cost, not its profile.
    let point = |value: f64| {
        plain_p[parameter] = value;
        robust_p[parameter] = value;
        let squares = problem.residuals(&plain_p);
        let least_squares: f64 = squares.iter().map(|each| each.whitened_squared(&plain.noise)).sum();
        let residuals = problem.residuals(&robust_p);
        let rows = problem.measurements.iter().zip(&residuals);
        let costs = rows.map(|(measurement, residual)| {
            // `distance` was scaled to one component; the cost of a row with three has three times the squares.
            let stretch = median_norm(measurement.component_count()) / median_norm(1);
            stretch * stretch * robust.loss.cost(distance(measurement, residual, &noise))
        });
        CostPoint {
            value,
            least_squares_m2: least_squares * plain.noise.position_m.powi(2),
            robust_m2: costs.sum::<f64>() * noise.position_m.powi(2),
        }
    };
    values.map(point).collect()
}
