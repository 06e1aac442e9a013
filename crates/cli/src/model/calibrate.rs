//! `congruent calibrate`: corrections of a robot from measurements.

#![expect(clippy::doc_markdown, reason = "the comments are printed as help, where backticks are noise")]

use std::{fmt::Write, path::PathBuf};

use congruent::{
    calibration::{
        CalibrationOptions, Loss, Noise, calibrate,
        estimation::ParameterUnit,
        measurements::{MeasuredRow, read_measurements},
        needed_coordinates,
        report::{CalibrationReport, CalibrationVerdict, FitSummary, Recommendation, ResidualSummary, plot},
    },
    description::{
        Diagnostic, Robot,
        display::{length_and_angle, number},
        units::Unit,
    },
    page::calibration_page,
};

use crate::{
    failure::{FAILED, Failure, NOTHING},
    input::{ArmArguments, files_of, named},
    output::{file::refuse_same, page::PageArgument, plot::PlotArgument},
    terminal::{
        print::Printer,
        progress::waiting,
        table::{column_width, wrapped},
    },
};

/// Corrections of a robot's model from measured poses or points of its tip (or TCP) in the base.
///
/// MEASUREMENTS is CSV with a header (`<joint>_rad` or `_deg`, then x_m, y_m, z_m or _mm, optionally qw, qx, qy,
/// qz or roll_deg, pitch_deg, yaw_deg), or JSON: [{"q": {joint: rad}, "translation_m": [x, y, z],
/// "quaternion_wxyz": [w, x, y, z]}]. Coordinates that were not measured are left out. Measurements count
/// from 1, in the order of the file.
///
/// Exit code 1 if the corrections do not explain the measurements (the residual is too large for noise, or for
/// the stated noise, the file is likely meant in other units, another order or frame, or a length would have to
/// change by more than a tenth of the reach), 4 if no correction
/// can be identified or the corrections cannot be verified.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: ArmArguments,
    /// CSV or JSON file of joint positions and measured poses or points, or - for standard input.
    measurements: PathBuf,
    /// Corrections that are estimated: zero-offsets, dh, axes, base, tool, all, or single corrections such as
    /// elbow_joint.zero, elbow_joint.a, base.yaw; may be given several times.
    #[arg(long, value_delimiter = ',', default_value = "zero-offsets")]
    free: Vec<String>,
    /// Corrections that are held at nominal although --free names their group.
    #[arg(long, value_delimiter = ',')]
    hold: Vec<String>,
    /// Loss of the robust estimate that is given beside least squares.
    #[arg(long, default_value = "tukey", value_parser = named::<Loss>())]
    loss: Loss,
    /// Smallest ratio of singular values at which corrections count as identified.
    #[arg(long, default_value_t = CalibrationOptions::default().threshold)]
    threshold: f64,
    /// Known noise of one measured coordinate; otherwise it is estimated.
    #[arg(long, value_name = "MM")]
    noise_mm: Option<f64>,
    /// Known noise of one component of a measured orientation.
    #[arg(long, value_name = "DEG")]
    noise_deg: Option<f64>,
    /// Number of configurations that are suggested for the next measurements, at most 400.
    #[arg(long, default_value_t = 5)]
    next: usize,
    // The cost over the most significant correction, and the residual of each row.
    #[command(flatten)]
    plot: PlotArgument,
    #[command(flatten)]
    page: PageArgument,
    /// Seed of the random configurations of which the most informative are chosen.
    #[arg(long, default_value_t = 0)]
    seed: u64,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let description = arguments.arm.load(printer)?;
    let needed = needed_coordinates(&description)?;
    let rows = read_measurements(&arguments.measurements, &description.robot, &needed)?;
    let options = arguments.options(&rows)?;
    let mut inputs = files_of(&description);
    inputs.push(arguments.measurements.clone());
    arguments.plot.is_none_of(&inputs)?;
    arguments.page.is_none_of(&inputs)?;
    refuse_same(arguments.plot.output().into_iter().chain(arguments.page.output()))?;
    let report = waiting(printer, "calibrating", || calibrate(&description, &rows, &options))?;
    printer.result(&report, |report| text(report, &description.robot))?;
    let plotted = arguments.plot.write(|| plot::svg(&report), &inputs);
    arguments.page.write(|| calibration_page(&report, &description.robot), &inputs).and(plotted)?;
    Ok(match report.verdict {
        CalibrationVerdict::Explained
        | CalibrationVerdict::UnexplainedRows
        | CalibrationVerdict::NoImprovement => 0,
        CalibrationVerdict::Unexplained
        | CalibrationVerdict::Misinterpreted
        | CalibrationVerdict::TooLarge
        | CalibrationVerdict::NoiseExceeded => FAILED,
        CalibrationVerdict::Unverifiable | CalibrationVerdict::NothingIdentified => NOTHING,
    })
}

impl Arguments {
    fn options(&self, rows: &[MeasuredRow]) -> Result<CalibrationOptions, Diagnostic> {
        let has_orientation = rows.iter().any(|row| row.orientation.is_some());
        let positive = |name: &str, value: f64| {
            if value.is_finite() && value > 0.0 {
                return Ok(value);
            }
            Err(Diagnostic::error("cli::value", format!("--{name} {value} is not a positive number")))
        };
        let noise = match (self.noise_mm, self.noise_deg) {
            (None, None) => None,
            (Some(millimetres), degrees) if degrees.is_some() || !has_orientation => {
                let position_m = Unit::Length.convert(positive("noise-mm", millimetres)?);
                let degrees = positive("noise-deg", degrees.unwrap_or(1.0))?;
                let orientation_rad = Unit::Angle.convert(degrees);
                Some(Noise { position_m, orientation_rad })
            }
            _ => {
                return Err(Diagnostic::error("cli::noise", "only one of the two noises is given")
                    .with_help("give both --noise-mm and --noise-deg, or neither"));
            }
        };
        Ok(CalibrationOptions {
            free: self.free.clone(),
            hold: self.hold.clone(),
            loss: self.loss,
            threshold: positive("threshold", self.threshold)?,
            noise,
            suggestions: self.next,
            seed: self.seed,
        })
    }
}

fn text(report: &CalibrationReport, robot: &Robot) -> String {
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
    fixed(&mut text, report);
    fits(&mut text, report);
    outliers(&mut text, report);
    next(&mut text, report, robot);
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
        "\n  fixed at nominal (singular value below {} of the largest)",
        number(report.identifiability.threshold)
    );
    let width = column_width(report.fixed.iter().map(|each| each.name.len()));
    for each in &report.fixed {
        let _ = writeln!(text, "  {:width$}  {}", each.name, each.reason);
    }
}

fn fits(text: &mut String, report: &CalibrationReport) {
    let _ = writeln!(text, "\n  {:16}  {:>26}  {:>26}", "residual", "root mean square", "worst");
    let mut line = |name: &str, residuals: &ResidualSummary, noise: Option<&FitSummary>| {
        let rms = length_and_angle(residuals.rms_m, residuals.rms_rad);
        let worst = length_and_angle(residuals.worst_m, residuals.worst_rad);
        let noise = noise.filter(|of| of.noise_m.is_finite()).map_or_else(String::new, |of| {
            format!(
                "  noise of a component {}",
                length_and_angle(of.noise_m, if residuals.worst_rad > 0.0 { of.noise_rad } else { 0.0 })
            )
        });
        let _ = writeln!(text, "  {name:16}  {rms:>26}  {worst:>26}{noise}");
    };
    line("nominal", &report.nominal, None);
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
        let _ = writeln!(text, "  {} bit at", number(pose.gain_bits));
        *text += &wrapped(&pose.q.for_people(robot));
    }
}
