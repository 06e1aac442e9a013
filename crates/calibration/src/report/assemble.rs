//! Assembles the report from the results of a calibration.

use std::collections::BTreeMap;

use congruent_description::{DhRowKind, JointValues, RowKey};
use congruent_input::{Finding, line_column};
use nalgebra::DMatrix;

use super::{
    calibration_report::{
        AlignedFrames, CalibratedModel, CalibrationReport, CalibrationVerdict, CorrectedTableEntry,
        CostCurve, EstimatedCorrection, FitSummary, HeldOutSummary, Identifiability, Recommendation,
        RowEntry, RowResidual, SuggestedConfiguration,
    },
    fixed::reported_fixed,
    frames::frames,
    residual_size::{ReachScale, ResidualSize},
    residual_summary::{angle, distance, summary},
    statements,
    verdict::{explanation, reinterpreted},
};
use crate::{
    camera::measured_frame,
    computed::Computed,
    estimation::{
        CalibrationFit, CorrectionEntry, CorrectionParameter, Measurement, Noise, PoseResidual, Problem,
        Suggestion, configurations, cost_curve,
    },
    measurements::MeasuredRow,
};

/// A correction below this many standard deviations is not significant. No unit; kind: choice, 95 % of normal noise.
const SIGNIFICANT_SIGMAS: f64 = 2.0;

/// The report of a calibration, with verdict, estimates, residuals and sentences.
pub(crate) fn report(computed: &Computed<'_>) -> CalibrationReport {
    let measured_frame = measured_frame(computed.description, computed.options.camera);
    let (frames, camera) = frames(computed);
    let nothing = vec![0.0; computed.chain.parameters().len()];
    let nominal = residuals(computed, &nothing);
    let held_out = held_out(computed, &nominal);
    let (corrected_size, nominal_size) = residual_sizes(computed, &nominal);
    let verdict = explanation(computed, held_out.as_ref(), [&corrected_size, &nominal_size], camera.as_ref());
    let (verdict, likely_reason) = reinterpreted(computed, verdict, &corrected_size);
    let row_residuals = rows(computed, &nominal);
    let mut report = CalibrationReport {
        robot: computed.description.name.clone(),
        chain: computed.description.reported_chain(),
        model: if computed.nominal.table.is_some() { CalibratedModel::Dh } else { CalibratedModel::Urdf },
        measured_frame,
        rows: computed.rows.len(),
        configurations: configurations(&computed.measurements).iter().max().map_or(0, |last| last + 1),
        components: computed.measurements.iter().map(Measurement::component_count).sum(),
        redundancy: computed.redundancy,
        verdict,
        likely_reason,
        recommended: recommendation(computed, verdict),
        statements: Vec::new(),
        parameters: estimates(computed),
        aligned: aligned(computed),
        frames,
        camera,
        fixed: computed
            .identification
            .fixed
            .iter()
            .map(|each| reported_fixed(&computed.chain, each))
            .collect(),
        identifiability: Identifiability {
            threshold: computed.options.threshold,
            singular_values: computed.identification.singular_values.clone(),
            kept_ratio: computed.identification.kept_ratio,
        },
        nominal: summary(&nominal),
        least_squares: fit_summary(computed, &computed.least_squares),
        robust: fit_summary(computed, &computed.robust.fit),
        loss: computed.options.loss,
        held_out,
        outliers: computed.outlier_rows.iter().map(|&row| row_residuals[row]).collect(),
        row_residuals,
        covariance: rows_of(&computed.least_squares.covariance),
        cost_curve: curve(computed),
        next: next(computed),
        written: None,
        warnings: computed.description.warnings.iter().map(Finding::from).collect(),
    };
    report.statements = statements::statements(&report, largest(computed, &report.parameters));
    report
}

/// Which estimate to use.
fn recommendation(computed: &Computed<'_>, verdict: CalibrationVerdict) -> Recommendation {
    match verdict {
        CalibrationVerdict::Explained
        | CalibrationVerdict::UnexplainedRows
        | CalibrationVerdict::NoiseExceeded => {
            if computed.is_robust_best() {
                Recommendation::Robust
            } else {
                Recommendation::LeastSquares
            }
        }
        _ => Recommendation::Nominal,
    }
}

/// The length whose correction is too large for an assembly error, with its correction, m.
fn largest<'a>(
    computed: &Computed<'_>,
    estimates: &'a [EstimatedCorrection],
) -> Option<(&'a EstimatedCorrection, f64)> {
    let problem = Problem { chain: &computed.chain, measurements: &computed.measurements };
    let corrections = &computed.best().corrections;
    let at = ReachScale::for_problem(&problem).too_large(&computed.chain, corrections)?;
    let estimate = computed.identification.kept.iter().position(|&kept| kept == at)?;
    Some((&estimates[estimate], corrections[at]))
}

fn residuals(computed: &Computed<'_>, corrections: &[f64]) -> Vec<PoseResidual> {
    Problem { chain: &computed.chain, measurements: &computed.measurements }.residuals(corrections)
}

fn fit_summary(computed: &Computed<'_>, fit: &CalibrationFit) -> FitSummary {
    let Noise { position_m, orientation_rad } = fit.noise;
    let is_known = computed.redundancy > 0 || computed.options.noise.is_some();
    let known = |noise: f64| if is_known { noise } else { f64::NAN };
    FitSummary {
        residuals: summary(&fit.residuals),
        noise_m: known(position_m),
        noise_rad: known(orientation_rad),
        converged: fit.converged,
        iterations: fit.iterations,
    }
}

fn held_out(computed: &Computed<'_>, nominal: &[PoseResidual]) -> Option<HeldOutSummary> {
    let held_out = computed.held_out.as_ref()?;
    let inliers = |residuals: &[PoseResidual]| -> Vec<PoseResidual> {
        let rows = residuals.iter().enumerate();
        rows.filter(|(row, _)| !computed.outlier_rows.contains(row)).map(|(_, each)| *each).collect()
    };
    let (corrected, nominal) = (summary(&inliers(&held_out.residuals)), summary(&inliers(nominal)));
    Some(HeldOutSummary {
        folds: held_out.folds,
        rms_m: corrected.rms_m,
        rms_rad: corrected.rms_rad,
        nominal_rms_m: nominal.rms_m,
        nominal_rms_rad: nominal.rms_rad,
    })
}

/// Residual of the inliers with the corrections (held out if possible) and with the nominal model.
fn residual_sizes(computed: &Computed<'_>, nominal: &[PoseResidual]) -> (ResidualSize, ResidualSize) {
    let problem = Problem { chain: &computed.chain, measurements: &computed.measurements };
    let reach_scale = ReachScale::for_problem(&problem);
    let held_out = computed.held_out.as_ref().map(|held_out| &held_out.residuals);
    let residuals = held_out.unwrap_or(&computed.best().residuals);
    let size = |residuals: &[PoseResidual]| reach_scale.residual_size(residuals, &computed.outlier_rows);
    (size(residuals), size(nominal))
}

fn estimates(computed: &Computed<'_>) -> Vec<EstimatedCorrection> {
    let best = computed.best();
    let (plain, robust) = (&computed.least_squares, &computed.robust.fit);
    let estimate = |&at: &usize| {
        let parameter = &computed.chain.parameters()[at];
        // NaN deviations compare as false: without a known noise nothing is significant.
        let significant = best.corrections[at].abs() > SIGNIFICANT_SIGMAS * best.standard_deviations[at];
        EstimatedCorrection {
            name: parameter.name.clone(),
            unit: parameter.unit(),
            correction: plain.corrections[at],
            standard_deviation: plain.standard_deviations[at],
            robust_correction: robust.corrections[at],
            robust_standard_deviation: robust.standard_deviations[at],
            significant,
            in_table: in_table(computed, parameter, best.corrections[at]),
        }
    };
    computed.identification.kept.iter().map(estimate).collect()
}

/// The table entry that a correction changes, if it changes exactly one: table entries do, and joint zeros, with the sign of
/// the row.
fn in_table(
    computed: &Computed<'_>,
    parameter: &CorrectionParameter,
    correction: f64,
) -> Option<CorrectedTableEntry> {
    let (table, _) = computed.nominal.table.as_ref()?;
    let row = &table.rows[parameter.joint?];
    // A zero is corrected in the direction of the joint, which the sign of the row may reverse; table entries
    // have no sign.
    let sign = if parameter.entry == CorrectionEntry::Zero { row.sign } else { 1.0 };
    let (entry, nominal) = match (parameter.entry, row.kind) {
        (CorrectionEntry::Zero | CorrectionEntry::JointEntry, DhRowKind::Revolute)
        | (CorrectionEntry::ConstantEntry, DhRowKind::Prismatic) => (RowEntry::Theta, row.theta_rad),
        (CorrectionEntry::Zero | CorrectionEntry::JointEntry, DhRowKind::Prismatic)
        | (CorrectionEntry::ConstantEntry, DhRowKind::Revolute) => (RowEntry::D, row.d_m),
        (CorrectionEntry::A, _) => (RowEntry::A, row.a_m),
        (CorrectionEntry::Alpha, _) => (RowEntry::Alpha, row.alpha_rad),
        _ => return None,
    };
    let key = match entry {
        RowEntry::Theta => RowKey::Theta,
        RowEntry::D => RowKey::D,
        RowEntry::A => RowKey::A,
        RowEntry::Alpha => RowKey::Alpha,
    };
    let places = computed.description.places.robot_file.as_ref();
    let written = places.and_then(|places| {
        let place = places.value(parameter.joint?, key).filter(|place| place.is_written)?;
        Some(line_column(&places.source().text, place.span.start).0)
    });
    let line = written.unwrap_or(row.line);
    Some(CorrectedTableEntry { entry, nominal, corrected: nominal + sign * correction, line })
}

fn rows_of(matrix: &DMatrix<f64>) -> Vec<Vec<f64>> {
    matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
}

fn aligned(computed: &Computed<'_>) -> Option<AlignedFrames> {
    let (parameters, start) = (computed.chain.parameters(), computed.chain.start());
    let moved = parameters.iter().zip(start).filter(|(_, value)| **value != 0.0);
    let corrections: BTreeMap<String, f64> =
        moved.map(|(parameter, value)| (parameter.name.clone(), *value)).collect();
    let residuals = || summary(&residuals(computed, start));
    (!corrections.is_empty()).then(|| AlignedFrames { corrections, residuals: residuals() })
}

fn rows(computed: &Computed<'_>, nominal: &[PoseResidual]) -> Vec<RowResidual> {
    let row = |(at, measured): (usize, &MeasuredRow)| {
        let (plain, robust) = (&computed.least_squares.residuals[at], &computed.robust.fit.residuals[at]);
        RowResidual {
            row: at + 1,
            line: measured.line,
            nominal_m: distance(&nominal[at]),
            nominal_rad: angle(&nominal[at]),
            least_squares_m: distance(plain),
            least_squares_rad: angle(plain),
            robust_m: distance(robust),
            robust_rad: angle(robust),
            weight: computed.robust.weights[at],
        }
    };
    computed.rows.iter().enumerate().map(row).collect()
}

/// The cost as a function of the most significant correction, over a range that contains nominal and both estimates with a
/// margin.
fn curve(computed: &Computed<'_>) -> Option<CostCurve> {
    const MARGIN_SIGMAS: f64 = 2.5;
    const STEPS: u32 = 160;
    let best = computed.best();
    let significance = |at: usize| best.corrections[at].abs() / best.standard_deviations[at];
    let kept = computed.identification.kept.iter().enumerate();
    let (index, &parameter) =
        // Of equal significance the first correction, so that the figure does not depend on rounding.
        kept.max_by(|a, b| significance(*a.1).total_cmp(&significance(*b.1)).then(b.0.cmp(&a.0)))?;
    let (plain, robust) = (&computed.least_squares, &computed.robust);
    let marked = [0.0, plain.corrections[parameter], robust.fit.corrections[parameter]];
    let sigma = plain.standard_deviations[parameter].max(robust.fit.standard_deviations[parameter]);
    let margin = MARGIN_SIGMAS * if sigma.is_finite() { sigma } else { 0.0 };
    let lower = marked.into_iter().fold(f64::INFINITY, f64::min) - margin;
    let upper = marked.into_iter().fold(f64::NEG_INFINITY, f64::max) + margin;
    let problem = Problem { chain: &computed.chain, measurements: &computed.measurements };
    let values = (0..=STEPS).map(|step| lower + (upper - lower) * f64::from(step) / f64::from(STEPS));
    let points = cost_curve(&problem, plain, robust, parameter, values);
    Some(CostCurve {
        parameter: index,
        values: points.iter().map(|point| point.value).collect(),
        least_squares_m2: points.iter().map(|point| point.least_squares_m2).collect(),
        robust_m2: points.iter().map(|point| point.robust_m2).collect(),
    })
}

fn next(computed: &Computed<'_>) -> Vec<SuggestedConfiguration> {
    let names: Vec<String> = computed.nominal.joint_names().into_iter().map(str::to_owned).collect();
    let pose = |suggestion: &Suggestion| {
        let q = computed.nominal.chain_positions(&computed.candidates[suggestion.candidate]);
        SuggestedConfiguration { q: JointValues::new(&names, &q), gain_bits: suggestion.gain_bits }
    };
    computed.next.iter().map(pose).collect()
}
