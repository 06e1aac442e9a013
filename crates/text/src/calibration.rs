//! What `congruent calibrate` prints.

use std::fmt::Write;

use super::{
    calibrated_robot::{frames_text, written_text},
    layout::{column_width, wrapped},
};
use congruent_calibration::{
    estimation::ParameterUnit,
    report::{CalibrationReport, FitSummary, Recommendation, ResidualSummary},
};
use congruent_description::Robot;
use congruent_input::display::{length_and_angle, number};

/// What `congruent calibrate` prints: the corrections with their uncertainty, the residuals before and after, outliers,
/// and what to measure next.
pub fn calibration_text(report: &CalibrationReport, robot: &Robot) -> String {
    let mut text = String::new();
    let _ = writeln!(
        text,
        "{}: {} measurements of {} ({} components), model {}",
        report.robot, report.rows, report.measured_frame, report.components, report.model
    );
    let _ = writeln!(text, "  {}", report.chain);
    for statement in &report.statements {
        let _ = writeln!(text, "  {statement}");
    }
    estimates(&mut text, report);
    frames_text(&mut text, report);
    fixed(&mut text, report);
    fits(&mut text, report);
    outliers(&mut text, report);
    next(&mut text, report, robot);
    written_text(&mut text, report.written.as_ref(), &report.chain);
    text
}

fn estimates(text: &mut String, report: &CalibrationReport) {
    if report.parameters.is_empty() {
        return;
    }
    let width = column_width(report.parameters.iter().map(|each| each.name.len())).max("correction".len());
    let _ = writeln!(
        text,
        "\n  {:width$}  {:>23}  {:>23}",
        "correction",
        "least squares",
        report.loss.to_string()
    );
    for each in &report.parameters {
        let unit = each.unit;
        let plain = estimated(unit, each.correction, each.standard_deviation);
        let robust = estimated(unit, each.robust_correction, each.robust_standard_deviation);
        let mark = if each.significant { "significant" } else { "-" };
        let is_recommended = report.recommended != Recommendation::Nominal;
        let table = each.in_table.as_ref().filter(|_| is_recommended).map_or_else(String::new, |table| {
            let (nominal, corrected) = (unit.for_people(table.nominal), unit.for_people(table.corrected));
            let key = format!("{}_{}", table.entry, unit.name_for_people());
            format!("  line {}: {key} {nominal:.4} -> {corrected:.4}", table.line)
        });
        let _ = writeln!(text, "  {:width$}  {plain:>23}  {robust:>23}  {mark:11}{table}", each.name);
    }
    let recommended = match report.recommended {
        Recommendation::Nominal => "none: keep the nominal model",
        Recommendation::LeastSquares => "least squares",
        Recommendation::Robust => "the robust estimate",
    };
    let _ = writeln!(text, "  recommended: {recommended}");
}

/// A correction with its standard deviation, in degrees or millimetres as a robot file may have it.
fn estimated(unit: ParameterUnit, correction: f64, deviation: f64) -> String {
    let (correction, name) = (unit.for_people(correction), unit.name_for_people());
    if deviation.is_nan() {
        return format!("{correction:+.4} ± unknown {name}");
    }
    format!("{correction:+.4} ± {:.4} {name}", unit.for_people(deviation))
}

fn fixed(text: &mut String, report: &CalibrationReport) {
    if report.fixed.is_empty() {
        return;
    }
    let _ = writeln!(
        text,
        "\n  held at {}, not identifiable (singular value < {} of the largest)",
        report.held_at(),
        number(report.identifiability.threshold)
    );
    let width = column_width(report.fixed.iter().map(|each| each.name.len()));
    for each in &report.fixed {
        let held_at = each.held_at_for_people().map_or_else(String::new, |at| format!("{at}; "));
        let _ = writeln!(text, "  {:width$}  {held_at}{}", each.name, each.reason);
    }
}

fn fits(text: &mut String, report: &CalibrationReport) {
    let _ = writeln!(text, "\n  {:16}  {:>26}  {:>26}", "residual", "root mean square", "worst");
    let mut line = |name: &str, residuals: &ResidualSummary, noise: Option<&FitSummary>| {
        let rms = length_and_angle(residuals.rms_m, residuals.rms_rad);
        let worst = length_and_angle(residuals.worst_m, residuals.worst_rad);
        let noise = noise.filter(|of| of.noise_m.is_finite()).map_or_else(String::new, |of| {
            format!(
                "  scatter of one coordinate {}",
                length_and_angle(of.noise_m, if residuals.worst_rad > 0.0 { of.noise_rad } else { 0.0 })
            )
        });
        let _ = writeln!(text, "  {name:16}  {rms:>26}  {worst:>26}{noise}");
    };
    line("nominal", &report.nominal, None);
    if let Some(aligned) = &report.aligned {
        let frames = if report.camera.is_some() { "camera and target" } else { "base and tool" };
        line(frames, &aligned.residuals, None);
    }
    line("least squares", &report.least_squares.residuals, Some(&report.least_squares));
    line(&report.loss.to_string(), &report.robust.residuals, Some(&report.robust));
    if let Some(error) = &report.held_out {
        let _ = writeln!(
            text,
            "  held out          {:>26}  ({} folds; nominal model on the same rows {})",
            length_and_angle(error.rms_m, error.rms_rad),
            error.folds,
            length_and_angle(error.nominal_rms_m, error.nominal_rms_rad)
        );
    }
}

fn outliers(text: &mut String, report: &CalibrationReport) {
    if report.outliers.is_empty() {
        return;
    }
    let _ = writeln!(text, "\n  outliers: residual with nominal, least squares, {}; weight", report.loss);
    for each in &report.outliers {
        let _ = writeln!(
            text,
            "  measurement {:4} (line {})  {:>26}  {:>26}  {:>26}  {:.2}",
            each.row,
            each.line,
            length_and_angle(each.nominal_m, each.nominal_rad),
            length_and_angle(each.least_squares_m, each.least_squares_rad),
            length_and_angle(each.robust_m, each.robust_rad),
            each.weight
        );
    }
}

fn next(text: &mut String, report: &CalibrationReport, robot: &Robot) {
    if report.next.is_empty() {
        return;
    }
    let _ = writeln!(
        text,
        "\n  most informative to measure next (within the joint limits; not checked for collisions)"
    );
    for pose in &report.next {
        let _ = writeln!(text, "  information gain {} bit at", number(pose.gain_bits));
        *text += &wrapped(&pose.q.for_people(robot));
    }
}
