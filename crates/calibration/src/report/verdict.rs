//! The verdict of a calibration: whether the corrections explain the measurements, and whether another reading of the file does.

use super::{
    calibration_report::{CalibrationVerdict, HeldOutSummary, LikelyReason},
    interpretation::{self, Misfit},
    residual_size::{LARGE_CORRECTION, ReachScale, ResidualSize},
    residual_summary::summary,
    target_scale::other_size,
};
use crate::{
    camera_frames::CameraFrames,
    computed::Computed,
    estimation::{Measurement, Noise, Problem},
};

/// Number of standard deviations of chi-squared by which the residuals may exceed a stated noise. No unit; kind: choice.
const NOISE_EXCESS_SIGMAS: f64 = 4.0;

/// Tries other interpretations of the file if the corrections explain nothing, or if they do so only by
/// being large: `dh` turns metres into millimetres by lengths a thousand times as short.
pub(super) fn reinterpreted(
    computed: &Computed<'_>,
    verdict: CalibrationVerdict,
    residual: &ResidualSize,
) -> (CalibrationVerdict, Option<LikelyReason>) {
    let problem = Problem { chain: &computed.chain, measurements: &computed.measurements };
    let size =
        ReachScale::for_problem(&problem).correction_size(&computed.chain, &computed.best().corrections);
    let is_judged =
        !matches!(verdict, CalibrationVerdict::Unverifiable | CalibrationVerdict::CameraUndetermined);
    let other = || other_size(&computed.nominal, computed.rows, computed.options, residual.rms_m);
    if let Some(reason) = is_judged.then(other).flatten() {
        return (CalibrationVerdict::Unexplained, Some(reason));
    }
    let misfit = match verdict {
        CalibrationVerdict::Unexplained => Misfit::Residual(residual.share()),
        CalibrationVerdict::Explained
        | CalibrationVerdict::UnexplainedRows
        | CalibrationVerdict::NoiseExceeded
            if size > LARGE_CORRECTION =>
        {
            Misfit::Correction(size)
        }
        _ => return (verdict, None),
    };
    let is_too_large = verdict != CalibrationVerdict::Unexplained
        && ReachScale::for_problem(&problem)
            .too_large(&computed.chain, &computed.best().corrections)
            .is_some();
    match interpretation::likely_reason(&computed.nominal, computed.rows, computed.options, misfit) {
        Some(reason) if verdict != CalibrationVerdict::Unexplained => {
            (CalibrationVerdict::Misinterpreted, Some(reason))
        }
        None if is_too_large => (CalibrationVerdict::TooLarge, None),
        reason => (verdict, reason),
    }
}

/// Whether the corrections explain the measurements as the file gives them; `corrected` and `nominal` are residuals with and without
/// corrections.
pub(super) fn explanation(
    computed: &Computed<'_>,
    held_out: Option<&HeldOutSummary>,
    [corrected, nominal]: [&ResidualSize; 2],
    camera: Option<&CameraFrames>,
) -> CalibrationVerdict {
    if computed.identification.kept.is_empty() {
        return CalibrationVerdict::NothingIdentified;
    }
    // A stated noise is a better scale than the reach.
    let is_noise = computed.options.noise.is_some() && !exceeds_noise(computed);
    if corrected.explains_nothing(nominal) && !is_noise {
        return CalibrationVerdict::Unexplained;
    }
    // After the check for large residuals: a misfit can be seen without redundancy, a good fit cannot be trusted
    // without it.
    if computed.redundancy == 0 || held_out.is_none() {
        return CalibrationVerdict::Unverifiable;
    }
    if camera.is_some_and(|camera| !camera.undetermined.is_empty()) {
        return CalibrationVerdict::CameraUndetermined;
    }
    if !computed.outlier_rows.is_empty() {
        return CalibrationVerdict::UnexplainedRows;
    }
    if computed.options.noise.is_some() && exceeds_noise(computed) {
        return CalibrationVerdict::NoiseExceeded;
    }
    let Noise { position_m, orientation_rad } = computed.least_squares.noise;
    // Positions and angles are made comparable by their noise, as in the cost.
    let size = |m: f64, rad: f64| (m / position_m).powi(2) + (rad / orientation_rad).powi(2);
    match held_out {
        Some(error)
            if size(error.rms_m, error.rms_rad) < size(error.nominal_rms_m, error.nominal_rms_rad) =>
        {
            CalibrationVerdict::Explained
        }
        _ => CalibrationVerdict::NoImprovement,
    }
}

/// Whether chi-squared of the residuals exceeds its degrees of freedom by more than the stated noise allows.
fn exceeds_noise(computed: &Computed<'_>) -> bool {
    let Noise { position_m, orientation_rad } = computed.least_squares.noise;
    let residuals = summary(&computed.least_squares.residuals);
    let chi_squared = residuals.cost_m2 / position_m.powi(2) + residuals.cost_rad2 / orientation_rad.powi(2);
    let components: usize = computed.measurements.iter().map(Measurement::component_count).sum();
    #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 components")]
    let freedom = components.saturating_sub(computed.identification.kept.len()) as f64;
    chi_squared > freedom + NOISE_EXCESS_SIGMAS * (2.0 * freedom).sqrt()
}
