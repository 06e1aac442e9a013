//! Residuals of rows, summed up.

use super::calibration_report::ResidualSummary;
use crate::estimation::PoseResidual;

/// Residuals of all rows.
pub(crate) fn summary(residuals: &[PoseResidual]) -> ResidualSummary {
    let sum = |of: fn(&PoseResidual) -> f64| residuals.iter().map(|each| of(each).powi(2)).sum::<f64>();
    let worst = |of: fn(&PoseResidual) -> f64| residuals.iter().map(of).fold(0.0, f64::max);
    #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 rows")]
    let count = residuals.len().max(1) as f64;
    let (cost_m2, cost_rad2) = (sum(distance), sum(angle));
    ResidualSummary {
        cost_m2,
        cost_rad2,
        rms_m: (cost_m2 / count).sqrt(),
        rms_rad: (cost_rad2 / count).sqrt(),
        worst_m: worst(distance),
        worst_rad: worst(angle),
    }
}

/// The distance of a row.
pub(super) fn distance(residual: &PoseResidual) -> f64 {
    residual.position_m.norm()
}

/// The angle of a row.
pub(super) fn angle(residual: &PoseResidual) -> f64 {
    residual.orientation_rad.norm()
}
