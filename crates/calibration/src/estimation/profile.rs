//! How the cost depends on one correction: what a figure of a calibration is drawn from.

use super::{
    estimate::Fit,
    noise::median_norm,
    residuals::Problem,
    robust::{Loss, RobustFit, distance},
};

/// The cost at one value of a correction, the others as estimated.
///
/// | field | unit | meaning |
/// |---|---|---|
/// | `value` | rad, m | of the correction |
/// | `least_squares_m2` | m2 | squared residuals; those of orientations weighted by the noise |
/// | `robust_m2` | m2 | the same through the robust loss, equal to it where residuals are small |
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CostPoint {
    /// Value of the correction.
    pub value: f64,
    /// Cost by least squares, others as least squares has them.
    pub least_squares_m2: f64,
    /// Cost by the robust loss, others as the robust estimate has them.
    pub robust_m2: f64,
}

/// The cost over the values of one correction.
///
/// # Panics
/// When the chain has no correction of this index.
pub fn cost_curve(
    problem: &Problem<'_>,
    (plain, robust, loss): (&Fit, &RobustFit, Loss),
    parameter: usize,
    values: impl Iterator<Item = f64>,
) -> Vec<CostPoint> {
    let (mut plain_p, mut robust_p) = (plain.corrections.clone(), robust.fit.corrections.clone());
    let noise = robust.scale;
    let point = |value: f64| {
        plain_p[parameter] = value;
        robust_p[parameter] = value;
        let squares = problem.residuals(&plain_p);
        let least_squares: f64 = squares.iter().map(|each| each.whitened_squared(&plain.noise)).sum();
        let residuals = problem.residuals(&robust_p);
        let rows = problem.measurements.iter().zip(&residuals);
        let costs = rows.map(|(measurement, residual)| {
            let components = measurement.position_count() + measurement.orientation_count();
            let stretch = median_norm(components) / median_norm(1);
            stretch * stretch * loss.cost(distance(measurement, residual, &noise))
        });
        CostPoint {
            value,
            least_squares_m2: least_squares * plain.noise.position_m.powi(2),
            robust_m2: costs.sum::<f64>() * noise.position_m.powi(2),
        }
    };
    values.map(point).collect()
}
