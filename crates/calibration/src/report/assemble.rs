//! From figures to the report.

use congruent_description::{DhRow, JointValues};

use super::{
    CalibrationReport, CalibrationVerdict, CostCurve, Estimate, Estimation, HeldOutError, Identifiability,
    LikelyReason, NextPose, Recommendation, Remainder, ReportedFixedParameter, RowResidual, TableEntry,
    reach_scale::{LARGE_CORRECTION, Left, ReachScale},
    reading::{self, Doubt},
    statements,
};
use crate::{
    computed::Computed,
    estimation::{
        Entry, Fit, FixedParameter, Loss, Measurement, Noise, ParameterUnit, Problem, Residual, Suggestion,
        cost_curve,
    },
};

/// A correction of fewer standard deviations is not significant: 95 % of normal noise.
const SIGNIFICANT_SIGMAS: f64 = 2.0;
/// How many standard deviations of chi-squared the residuals may exceed a stated noise by.
const NOISE_EXCESS_SIGMAS: f64 = 4.0;

/// The whole report.
pub(crate) fn report(computed: &Computed<'_>) -> CalibrationReport {
    let robot = &computed.description.robot;
    let tip = &robot.link(computed.description.tip).name;
    let measured_frame = if computed.description.tip_from_tcp.is_some() { "tcp" } else { tip };
    let nothing = vec![0.0; computed.chain.parameters().len()];
    let nominal = residuals(computed, &nothing);
    let held_out = held_out(computed, &nominal);
    let (left, before) = left(computed, &nominal);
    let verdict = explanation(computed, held_out.as_ref(), (&left, &before));
    let (verdict, likely_reason) = read_again(computed, verdict, &left);
    let recommended = match verdict {
        CalibrationVerdict::Explained
        | CalibrationVerdict::UnexplainedRows
        | CalibrationVerdict::NoiseExceeded => computed.best().1,
        _ => Recommendation::Nominal,
    };
    let row_residuals = rows(computed, &nominal);
    let mut report = CalibrationReport {
        robot: robot.name().to_owned(),
        model: if computed.nominal.table.is_some() { "dh" } else { "urdf" },
        measured_frame: measured_frame.to_owned(),
        rows: computed.rows.len(),
        components: computed
            .measurements
            .iter()
            .map(|each| each.position_count() + each.orientation_count())
            .sum(),
        redundancy: computed.redundancy,
        verdict,
        likely_reason,
        recommended,
        statements: Vec::new(),
        parameters: estimates(computed),
        fixed: computed.identification.fixed.iter().map(|each| fixed(computed, each)).collect(),
        identifiability: Identifiability {
            threshold: computed.options.threshold,
            singular_values: computed.identification.singular_values.clone(),
            kept_ratio: computed.identification.kept_ratio,
        },
        nominal: remainder(&nominal),
        least_squares: estimation(computed, &computed.least_squares),
        robust: estimation(computed, &computed.robust.fit),
        loss: match computed.options.loss {
            Loss::Huber => "huber",
            Loss::Cauchy => "cauchy",
            Loss::Tukey => "tukey",
        },
        held_out,
        outliers: computed.outlier_rows.iter().map(|&row| row_residuals[row]).collect(),
        row_residuals,
        covariance: computed
            .least_squares
            .covariance
            .row_iter()
            .map(|row| row.iter().copied().collect())
            .collect(),
        cost_curve: curve(computed),
        next: next(computed),
    };
    report.statements = statements::statements(&report);
    report
}

fn residuals(computed: &Computed<'_>, corrections: &[f64]) -> Vec<Residual> {
    let residual = |each: &Measurement| each.residual(&computed.chain.base_from_tip(&each.q, corrections));
    computed.measurements.iter().map(residual).collect()
}

fn remainder(residuals: &[Residual]) -> Remainder {
    let sum = |of: fn(&Residual) -> f64| residuals.iter().map(|each| of(each).powi(2)).sum::<f64>();
    let worst = |of: fn(&Residual) -> f64| residuals.iter().map(of).fold(0.0, f64::max);
    #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 rows")]
    let count = residuals.len().max(1) as f64;
    let (cost_m2, cost_rad2) = (sum(distance), sum(angle));
    Remainder {
        cost_m2,
        cost_rad2,
        rms_m: (cost_m2 / count).sqrt(),
        rms_rad: (cost_rad2 / count).sqrt(),
        worst_m: worst(distance),
        worst_rad: worst(angle),
    }
}

fn distance(residual: &Residual) -> f64 {
    residual.position_m.norm()
}

fn angle(residual: &Residual) -> f64 {
    residual.orientation_rad.norm()
}

fn estimation(computed: &Computed<'_>, fit: &Fit) -> Estimation {
    let Noise { position_m, orientation_rad } = fit.noise;
    let is_known = computed.redundancy > 0 || computed.options.noise.is_some();
    let known = |noise: f64| if is_known { noise } else { f64::NAN };
    Estimation {
        left: remainder(&fit.residuals),
        noise_m: known(position_m),
        noise_rad: known(orientation_rad),
        converged: fit.converged,
        iterations: fit.iterations,
    }
}

fn held_out(computed: &Computed<'_>, nominal: &[Residual]) -> Option<HeldOutError> {
    let held_out = computed.held_out.as_ref()?;
    let fits = |residuals: &[Residual]| -> Vec<Residual> {
        let rows = residuals.iter().enumerate();
        rows.filter(|(row, _)| !computed.outlier_rows.contains(row)).map(|(_, each)| *each).collect()
    };
    let (left, before) = (remainder(&fits(&held_out.residuals)), remainder(&fits(nominal)));
    Some(HeldOutError {
        folds: held_out.folds,
        rms_m: left.rms_m,
        rms_rad: left.rms_rad,
        nominal_rms_m: before.rms_m,
        nominal_rms_rad: before.rms_rad,
    })
}

/// What is left of the rows that fit, on rows that were left out where some could be; and before.
fn left(computed: &Computed<'_>, nominal: &[Residual]) -> (Left, Left) {
    let problem = Problem { chain: &computed.chain, measurements: &computed.measurements };
    let reach_scale = ReachScale::of(&problem);
    let unseen = computed.held_out.as_ref().map(|held_out| &held_out.residuals);
    let residuals = unseen.unwrap_or(&computed.best().0.residuals);
    let left = |residuals: &[Residual]| reach_scale.left(residuals, &computed.outlier_rows);
    (left(residuals), left(nominal))
}

/// Tries other readings of the file where the corrections explain nothing, and where they do so only by
/// being large: `dh` turns metres into millimetres by lengths a thousand times as short.
fn read_again(
    computed: &Computed<'_>,
    verdict: CalibrationVerdict,
    left: &Left,
) -> (CalibrationVerdict, Option<LikelyReason>) {
    let problem = Problem { chain: &computed.chain, measurements: &computed.measurements };
    let size = ReachScale::of(&problem).size_of(&computed.chain, &computed.best().0.corrections);
    let doubt = match verdict {
        CalibrationVerdict::Unexplained => Doubt::Left(left.share()),
        CalibrationVerdict::Explained | CalibrationVerdict::UnexplainedRows if size > LARGE_CORRECTION => {
            Doubt::Size(size)
        }
        _ => return (verdict, None),
    };
    match reading::likely_reason(&computed.nominal, computed.rows, computed.options, doubt) {
        Some(reason) if verdict != CalibrationVerdict::Unexplained => {
            (CalibrationVerdict::Misread, Some(reason))
        }
        reason => (verdict, reason),
    }
}

fn explanation(
    computed: &Computed<'_>,
    held_out: Option<&HeldOutError>,
    (left, before): (&Left, &Left),
) -> CalibrationVerdict {
    if computed.identification.kept.is_empty() {
        return CalibrationVerdict::NothingIdentified;
    }
    // Where the noise is stated, that is the reach_scale.
    let is_noise = computed.options.noise.is_some() && !exceeds_noise(computed);
    if left.explains_nothing(before) && !is_noise {
        return CalibrationVerdict::Unexplained;
    }
    if computed.redundancy == 0 || held_out.is_none() {
        return CalibrationVerdict::NothingToJudgeBy;
    }
    if !computed.outlier_rows.is_empty() {
        return CalibrationVerdict::UnexplainedRows;
    }
    if computed.options.noise.is_some() && exceeds_noise(computed) {
        return CalibrationVerdict::NoiseExceeded;
    }
    let Noise { position_m, orientation_rad } = computed.least_squares.noise;
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

/// Chi-squared of least squares against its degrees of freedom.
fn exceeds_noise(computed: &Computed<'_>) -> bool {
    let Noise { position_m, orientation_rad } = computed.least_squares.noise;
    let left = remainder(&computed.least_squares.residuals);
    let chi_squared = left.cost_m2 / position_m.powi(2) + left.cost_rad2 / orientation_rad.powi(2);
    let components: usize =
        computed.measurements.iter().map(|each| each.position_count() + each.orientation_count()).sum();
    #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 components")]
    let freedom = components.saturating_sub(computed.identification.kept.len()) as f64;
    chi_squared > freedom + NOISE_EXCESS_SIGMAS * (2.0 * freedom).sqrt()
}

fn estimates(computed: &Computed<'_>) -> Vec<Estimate> {
    let (best, _) = computed.best();
    let (plain, robust) = (&computed.least_squares, &computed.robust.fit);
    let estimate = |&at: &usize| {
        let parameter = &computed.chain.parameters()[at];
        let significant = best.corrections[at].abs() > SIGNIFICANT_SIGMAS * best.standard_deviations[at];
        Estimate {
            name: parameter.name.clone(),
            unit: unit(parameter.unit()),
            correction: plain.corrections[at],
            standard_deviation: plain.standard_deviations[at],
            robust_correction: robust.corrections[at],
            robust_standard_deviation: robust.standard_deviations[at],
            significant,
            in_table: in_table(computed, &parameter.name, (parameter.entry, best.corrections[at])),
        }
    };
    computed.identification.kept.iter().map(estimate).collect()
}

pub(super) fn unit(unit: ParameterUnit) -> &'static str {
    match unit {
        ParameterUnit::Angle => "rad",
        ParameterUnit::Length => "m",
    }
}

/// The entry of the table that a correction changes, if it changes one alone: table entries do, and
/// zeros, by the row's sign.
fn in_table(computed: &Computed<'_>, name: &str, (entry, correction): (Entry, f64)) -> Option<TableEntry> {
    let (joint, word) = name.rsplit_once('.')?;
    let (table, _) = computed.nominal.table.as_ref()?;
    let row: &DhRow = table.rows.iter().find(|row| computed.nominal.robot.joint(row.joint).name == joint)?;
    let revolute = computed.nominal.robot.joint(row.joint).kind.is_angular();
    let (entry, found, correction) = match (entry, word) {
        (Entry::Zero, _) if revolute => ("theta", row.theta_rad, row.sign * correction),
        (Entry::Zero, _) => ("d", row.d_m, row.sign * correction),
        (_, "theta") => ("theta", row.theta_rad, correction),
        (_, "d") => ("d", row.d_m, correction),
        (_, "a") => ("a", row.a_m, correction),
        (_, "alpha") => ("alpha", row.alpha_rad, correction),
        _ => return None,
    };
    Some(TableEntry { entry, found, corrected: found + correction, line: row.line })
}

fn fixed(computed: &Computed<'_>, fixed: &FixedParameter) -> ReportedFixedParameter {
    let parameters = computed.chain.parameters();
    let terms: Vec<(&str, f64, &'static str)> = fixed
        .correlated_with
        .iter()
        .map(|&(at, factor)| (parameters[at].name.as_str(), factor, unit(parameters[at].unit())))
        .collect();
    let own = &parameters[fixed.parameter];
    ReportedFixedParameter {
        name: own.name.clone(),
        correlated_with: terms.iter().map(|(name, factor, _)| ((*name).to_owned(), *factor)).collect(),
        reason: statements::why_fixed(unit(own.unit()), &terms),
    }
}

fn rows(computed: &Computed<'_>, nominal: &[Residual]) -> Vec<RowResidual> {
    let row = |(at, measured): (usize, &crate::measurements::MeasuredRow)| {
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

/// The cost over the most significant correction, from a few deviations below to a few above
/// both estimates and nominal.
fn curve(computed: &Computed<'_>) -> Option<CostCurve> {
    const MARGIN_SIGMAS: f64 = 2.5;
    const STEPS: u32 = 160;
    let (best, _) = computed.best();
    let significance = |at: usize| best.corrections[at].abs() / best.standard_deviations[at];
    let kept = computed.identification.kept.iter().enumerate();
    let (index, &parameter) =
        kept.max_by(|a, b| significance(*a.1).total_cmp(&significance(*b.1)).then(b.0.cmp(&a.0)))?;
    let (plain, robust) = (&computed.least_squares, &computed.robust);
    let marked = [0.0, plain.corrections[parameter], robust.fit.corrections[parameter]];
    let sigma = plain.standard_deviations[parameter].max(robust.fit.standard_deviations[parameter]);
    let margin = MARGIN_SIGMAS * if sigma.is_finite() { sigma } else { 0.0 };
    let lower = marked.into_iter().fold(f64::INFINITY, f64::min) - margin;
    let upper = marked.into_iter().fold(f64::NEG_INFINITY, f64::max) + margin;
    let problem = Problem { chain: &computed.chain, measurements: &computed.measurements };
    let values = (0..=STEPS).map(|step| lower + (upper - lower) * f64::from(step) / f64::from(STEPS));
    let points = cost_curve(&problem, (plain, robust, computed.options.loss), parameter, values);
    Some(CostCurve {
        parameter: index,
        values: points.iter().map(|point| point.value).collect(),
        least_squares_m2: points.iter().map(|point| point.least_squares_m2).collect(),
        robust_m2: points.iter().map(|point| point.robust_m2).collect(),
    })
}

fn next(computed: &Computed<'_>) -> Vec<NextPose> {
    let names: Vec<String> = computed.nominal.joint_names().into_iter().map(str::to_owned).collect();
    let pose = |suggestion: &Suggestion| {
        let q = computed.nominal.of_configuration(&computed.candidates[suggestion.candidate]);
        NextPose { q: JointValues::new(&names, &q), gain_bits: suggestion.gain_bits }
    };
    computed.next.iter().map(pose).collect()
}
