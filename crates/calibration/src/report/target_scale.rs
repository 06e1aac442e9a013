//! The size of a camera's target: a board whose squares are larger than its file says is seen nearer than it is.

use super::{
    calibration_report::LikelyReason,
    interpretation::{self, Interpretation},
};
use crate::{chain::NominalChain, measurements::MeasuredRow, options::CalibrationOptions};

/// Sizes that are tried first, as multiples of the written one: half and double are a cell that was counted as two.
const TRIED: [f64; 9] = [0.25, 0.5, 0.8, 0.9, 1.0, 1.1, 1.25, 2.0, 4.0];
/// Relative distance of the sizes through which a parabola is laid: squared residuals are one in the size.
const STEPS: [f64; 3] = [0.02, 0.005, 0.002];
/// Another size explains the rows if its residual is less than this share of that with the written size. Kind: judgement.
const MUCH_BETTER: f64 = 0.4;
/// A size nearer to the written one is no mistake. Kind: judgement: half a per cent is an ordinary print.
const ALIKE: f64 = 0.004;

/// That the target has another size, if that explains the rows much better.
pub(super) fn other_size(
    nominal: &NominalChain<'_>,
    rows: &[MeasuredRow],
    options: &CalibrationOptions,
    rms_m: f64,
) -> Option<LikelyReason> {
    options.camera?;
    let fit = |scale: f64| {
        let scaled = Interpretation::scaled(scale, options.camera);
        interpretation::interpreted_fit(nominal, rows, options, &scaled).map(|fit| fit.residual)
    };
    let squared = |scale: f64| fit(scale).map_or(f64::INFINITY, |residual| residual.rms_m.powi(2));
    let sized = TRIED.map(|scale| (scale, squared(scale)));
    let (mut scale, mut least) = sized.into_iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
    for step in STEPS {
        let [below, above] = [squared(scale * (1.0 - step)), squared(scale * (1.0 + step))];
        let curvature = below - 2.0 * least + above;
        // The vertex, no further than a quarter: beyond it the parabola is an extrapolation.
        let share = (0.5 * (below - above) / curvature * step).clamp(-0.25, 0.25);
        let vertex = scale * (1.0 + share);
        let at_vertex = squared(vertex);
        if !(share.is_finite() && at_vertex < least) {
            break;
        }
        (scale, least) = (vertex, at_vertex);
    }
    let residual = fit(scale)?;
    let is_other = (scale - 1.0).abs() > ALIKE && residual.rms_m < MUCH_BETTER * rms_m;
    is_other.then(|| LikelyReason {
        condition: format!("the target is {scale:.3} times as large as its file says (size of its squares)"),
        rms_m: residual.rms_m,
        rms_rad: residual.rms_rad,
    })
}
