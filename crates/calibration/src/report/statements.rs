//! The sentences of the report.

use std::fmt::Write;

use congruent_input::display::{first_of, length, length_and_angle, number};

use super::calibration_report::{
    AlignedFrames, CalibrationReport, CalibrationVerdict, EstimatedCorrection, Recommendation,
    ResidualSummary, RowResidual,
};
use crate::{
    camera_frames::CameraFrames,
    estimation::{FEWEST_CONFIGURATIONS, ParameterUnit},
};

/// Most terms of a relation that are listed.
const MOST_TERMS: usize = 4;
/// Most rows that are listed.
const MOST_ROWS: usize = 8;
/// A factor this near to 1 is not written. No unit; kind: display.
const UNIT_FACTOR: f64 = 1e-3;

/// Why a correction is fixed at nominal: the estimated corrections that it is correlated with, each with its
/// name, value and unit.
pub(super) fn why_fixed(unit: ParameterUnit, terms: &[(&str, f64, ParameterUnit)]) -> String {
    if let [(name, factor, of)] = terms
        && *of == unit
        && (factor.abs() - 1.0).abs() < UNIT_FACTOR
    {
        let what = if *factor > 0.0 { "sum" } else { "difference" };
        return format!("cannot be distinguished from {name}: only their {what} can be identified");
    }
    if terms.is_empty() {
        return "has no effect on these measurements".to_owned();
    }
    let mut largest = terms.to_vec();
    // The largest factors explain most of the effect, and only a few are listed.
    largest.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
    let term =
        |(name, factor, of): &(&str, f64, ParameterUnit)| format!("{} {of} of {name}", number(*factor));
    let terms: Vec<String> = largest.iter().map(term).collect();
    format!("is correlated: 1 {unit} of it has nearly the effect of {}", first_of(&terms, MOST_TERMS))
}

/// The sentences for a person who wants to use the corrections, the most important first; `largest` is a length with a
/// correction that is too large.
pub(super) fn statements(
    report: &CalibrationReport,
    largest: Option<(&EstimatedCorrection, f64)>,
) -> Vec<String> {
    let mut statements = vec![verdict(report, largest)];
    let insignificant: Vec<&str> =
        report.parameters.iter().filter(|each| !each.significant).map(|each| each.name.as_str()).collect();
    let is_known = report.parameters.iter().all(|each| each.standard_deviation.is_finite());
    if !insignificant.is_empty() && is_known {
        statements.push(format!(
            "not significantly different from zero (within two standard deviations): {}",
            insignificant.join(", ")
        ));
    }
    if let Some(aligned) = &report.aligned {
        let residual = |of: &ResidualSummary| length_and_angle(of.rms_m, of.rms_rad);
        let frames = match report.camera {
            Some(_) => "camera and target".to_owned(),
            None => aligned_frames(aligned),
        };
        statements.push(format!(
            "{frames} aligned with the measurements first: alone that gives a residual of {}, from {} with the nominal model",
            residual(&aligned.residuals),
            residual(&report.nominal)
        ));
    }
    if !report.fixed.is_empty() {
        let names: Vec<&str> = report.fixed.iter().map(|each| each.name.as_str()).collect();
        let (at, names) = (report.held_at(), names.join(", "));
        statements.push(format!("fixed at {at}, since these measurements do not identify them: {names}"));
    }
    for (estimate, fit) in [("least squares", &report.least_squares), ("the robust estimate", &report.robust)]
    {
        if !fit.converged {
            statements.push(format!("{estimate} did not converge in {} steps", fit.iterations));
        }
    }
    statements
}

fn aligned_frames(aligned: &AlignedFrames) -> String {
    let is_aligned =
        |frame: &str| aligned.corrections.keys().any(|name| name.split('.').next() == Some(frame));
    ["base", "tool"].into_iter().filter(|frame| is_aligned(frame)).collect::<Vec<_>>().join(" and ")
}

fn verdict(report: &CalibrationReport, largest: Option<(&EstimatedCorrection, f64)>) -> String {
    match report.verdict {
        CalibrationVerdict::NothingIdentified => {
            "none of the free corrections can be identified from these measurements".to_owned()
        }
        CalibrationVerdict::Unexplained => unexplained(report),
        CalibrationVerdict::Misinterpreted => misinterpreted(report),
        CalibrationVerdict::TooLarge => too_large(largest),
        CalibrationVerdict::Unverifiable => unverifiable(report),
        CalibrationVerdict::UnexplainedRows => unexplained_rows(report),
        CalibrationVerdict::CameraUndetermined => undetermined(report),
        CalibrationVerdict::NoiseExceeded => format!(
            "the residual ({} root mean square) is larger than the stated noise allows: the free corrections \
             do not explain the measurements",
            length_and_angle(report.least_squares.residuals.rms_m, report.least_squares.residuals.rms_rad)
        ),
        CalibrationVerdict::NoImprovement => {
            "on held-out rows the residual with the corrections is no smaller than with the nominal model: keep \
             the nominal model"
                .to_owned()
        }
        CalibrationVerdict::Explained => {
            let (corrected, nominal) = sizes(report);
            format!("the corrections explain the measurements: residual {corrected}, {nominal}")
        }
    }
}

/// The residual with the corrections, on held-out rows if there are any, and with the nominal model.
fn sizes(report: &CalibrationReport) -> (String, String) {
    let (corrected, nominal) = match &report.held_out {
        Some(error) => (
            format!("{} on held-out rows", length_and_angle(error.rms_m, error.rms_rad)),
            length_and_angle(error.nominal_rms_m, error.nominal_rms_rad),
        ),
        None => (
            length_and_angle(report.least_squares.residuals.rms_m, report.least_squares.residuals.rms_rad),
            length_and_angle(report.nominal.rms_m, report.nominal.rms_rad),
        ),
    };
    (corrected, format!("{nominal} with the nominal model"))
}

fn unexplained(report: &CalibrationReport) -> String {
    let (corrected, nominal) = sizes(report);
    let interpretation = match &report.likely_reason {
        Some(reason) => format!(
            "if {}, the residual is {}",
            reason.condition,
            length_and_angle(reason.rms_m, reason.rms_rad)
        ),
        None => "none of the errors of units, order, sign and frame that are tried explains them either; if the instrument is that \
                 inaccurate, say so with --noise"
            .to_owned(),
    };
    format!(
        "the free corrections do NOT explain the measurements: residual {corrected}, {nominal}; {interpretation}"
    )
}

fn misinterpreted(report: &CalibrationReport) -> String {
    report.likely_reason.as_ref().map_or_else(String::new, |reason| {
        format!(
            "the measurements are explained only by corrections as large as the arm itself; if {}, small \
             corrections explain them with a residual of {}",
            reason.condition,
            length_and_angle(reason.rms_m, reason.rms_rad)
        )
    })
}

fn too_large(largest: Option<(&EstimatedCorrection, f64)>) -> String {
    largest.map_or_else(String::new, |(parameter, correction)| {
        format!(
            "the measurements are explained only if {} is off by {}, more than a tenth of the reach: check the file for \
             wrong rows, and the model for a wrong value",
            parameter.name,
            length(correction.abs())
        )
    })
}

fn undetermined(report: &CalibrationReport) -> String {
    let motions = report.camera.as_ref().map(CameraFrames::undetermined_in_words);
    format!(
        "the measurements do not determine the camera: {}. Turn the tool about two axes that are not parallel, by 30 deg or more. \
         What an arm cannot turn, such as the height of a camera on a SCARA, must be measured otherwise",
        motions.unwrap_or_default()
    )
}

fn unverifiable(report: &CalibrationReport) -> String {
    if report.configurations == 1 && report.redundancy > 0 {
        return "all measurements are at one configuration: the corrections cannot be verified at others"
            .to_owned();
    }
    if report.redundancy > 0 {
        return format!(
            "the measurements are at {} configurations, too few to hold some out and verify the corrections there: measure at \
             {FEWEST_CONFIGURATIONS} or more",
            report.configurations
        );
    }
    format!(
        "the measurements are too few to verify {} corrections (repetitions at one configuration count once): \
         measure at more configurations",
        report.parameters.len()
    )
}

fn unexplained_rows(report: &CalibrationReport) -> String {
    let row = |each: &RowResidual| {
        format!("{} (off by {})", each.row, length_and_angle(each.least_squares_m, each.least_squares_rad))
    };
    let rows: Vec<String> = report.outliers.iter().map(row).collect();
    let (noun, are, them) = if rows.len() > 1 {
        ("measurements", "are outliers", "them")
    } else {
        ("measurement", "is an outlier", "it")
    };
    let corrections = match &report.parameters[..] {
        [only] => only.name.as_str(),
        _ => "the free corrections",
    };
    let mut text = format!("{noun} {} {are}: no value of {corrections} explains {them}", listed(&rows));
    if let (Recommendation::Robust, Some(error)) = (report.recommended, &report.held_out) {
        let error = length_and_angle(error.rms_m, error.rms_rad);
        let _ = write!(text, "; the robust estimate explains the other rows within {error} (held out)");
    }
    text
}

fn listed(rows: &[String]) -> String {
    match rows {
        [] => String::new(),
        [one] => one.clone(),
        rows if rows.len() > MOST_ROWS => first_of(rows, MOST_ROWS),
        [before @ .., last] => format!("{} and {last}", before.join(", ")),
    }
}
