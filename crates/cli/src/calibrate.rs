//! `congruent calibrate`: corrections of a robot from measurements.

#![expect(clippy::doc_markdown, reason = "the comments are printed as help, where backticks are noise")]

use std::{fmt::Write, path::PathBuf};

use clap::ValueEnum;
use congruent::{
    calibration::{
        CalibrationOptions, Loss, Noise, calibrate,
        measurements::{MeasuredRow, read_measurements},
        needed_coordinates,
        report::{
            CalibrationReport, CalibrationVerdict, Estimate, Estimation, Recommendation, Remainder, plot,
        },
    },
    description::Diagnostic,
    twin::report::write_whole,
};

use crate::{
    failure::{FAILED, Failure, NOTHING},
    input::RobotArgument,
    print::Printer,
};

/// Corrections of a robot's model from measured poses or points of its tip (or TCP) in the base.
///
/// MEASUREMENTS is CSV with a header (`<joint>_rad` or `_deg`, then x_m, y_m, z_m or _mm, optionally qw, qx, qy,
/// qz or roll_deg, pitch_deg, yaw_deg), or JSON: [{"q": {joint: rad}, "translation_m": [x, y, z],
/// "quaternion_wxyz": [w, x, y, z]}]. Coordinates that were not measured are left out. Measurements count
/// from 1, in the order of the file.
///
/// Exit code 1 where the corrections do not explain the measurements (what is left is no noise, or more than
/// the stated noise allows, or the file is likely read in the wrong units, order or frame), 4 where nothing can be identified or nothing is left to judge it by.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    /// CSV or JSON file of joint positions and measured poses or points.
    measurements: PathBuf,
    /// What is estimated: zero-offsets, dh, axes, base, tool, all, or single corrections such as
    /// elbow_joint.zero, elbow_joint.a, base.yaw; may be given several times.
    #[arg(long, value_delimiter = ',', default_value = "zero-offsets")]
    free: Vec<String>,
    /// What is held at nominal although --free names its group.
    #[arg(long, value_delimiter = ',')]
    hold: Vec<String>,
    /// Loss of the robust estimate that stands beside least squares.
    #[arg(long, value_enum, default_value_t = LossArgument::Tukey)]
    loss: LossArgument,
    /// Smallest ratio of singular values at which corrections still count as told apart.
    #[arg(long, default_value_t = CalibrationOptions::default().threshold)]
    threshold: f64,
    /// Known noise of one measured coordinate; otherwise it is estimated.
    #[arg(long, value_name = "MM")]
    noise_mm: Option<f64>,
    /// Known noise of one component of a measured orientation.
    #[arg(long, value_name = "DEG")]
    noise_deg: Option<f64>,
    /// Number of configurations that are suggested for the next measurements.
    #[arg(long, default_value_t = 5)]
    next: usize,
    /// Draws the cost over the most significant correction and the residual of each row, as SVG.
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,
    /// Seed of the configurations among which those are chosen.
    #[arg(long, default_value_t = 0)]
    seed: u64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum LossArgument {
    /// Quadratic near, linear far.
    Huber,
    /// Logarithmic.
    Cauchy,
    /// Bounded: a far row has no pull at all.
    Tukey,
}

impl From<LossArgument> for Loss {
    fn from(loss: LossArgument) -> Self {
        match loss {
            LossArgument::Huber => Self::Huber,
            LossArgument::Cauchy => Self::Cauchy,
            LossArgument::Tukey => Self::Tukey,
        }
    }
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let description = arguments.robot.load(printer)?;
    let needed = needed_coordinates(&description)?;
    let rows = read_measurements(&arguments.measurements, &description.robot, &needed)?;
    let options = arguments.options(&rows)?;
    let report = calibrate(&description, &rows, &options)?;
    if let Some(path) = &arguments.plot {
        let figure = plot::svg(&report).map_err(|error| Failure::Machine(error.to_string()))?;
        write_whole(path, figure.as_bytes()).map_err(|error| Failure::Machine(error.to_string()))?;
    }
    printer.result(&report, text)?;
    Ok(match report.verdict {
        CalibrationVerdict::Explained
        | CalibrationVerdict::UnexplainedRows
        | CalibrationVerdict::NoImprovement => 0,
        CalibrationVerdict::Unexplained | CalibrationVerdict::Misread | CalibrationVerdict::NoiseExceeded => {
            FAILED
        }
        CalibrationVerdict::NothingToJudgeBy | CalibrationVerdict::NothingIdentified => NOTHING,
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
                let position_m =
                    congruent::description::units::Unit::Length.convert(positive("noise-mm", millimetres)?);
                let degrees = positive("noise-deg", degrees.unwrap_or(1.0))?;
                let orientation_rad = congruent::description::units::Unit::Angle.convert(degrees);
                Some(Noise { position_m, orientation_rad })
            }
            _ => {
                return Err(Diagnostic::error("cli::noise", "the noise is given by half")
                    .with_help("give both --noise-mm and --noise-deg, or neither"));
            }
        };
        Ok(CalibrationOptions {
            free: self.free.clone(),
            hold: self.hold.clone(),
            loss: self.loss.into(),
            threshold: positive("threshold", self.threshold)?,
            noise,
            suggestions: self.next,
            seed: self.seed,
        })
    }
}

fn text(report: &CalibrationReport) -> String {
    let mut text = String::new();
    let _ = writeln!(
        text,
        "{}: {} measurements of {} ({} components), model {}",
        report.robot, report.rows, report.measured_frame, report.components, report.model
    );
    for statement in &report.statements {
        let _ = writeln!(text, "  {statement}");
    }
    estimates(&mut text, report);
    fixed(&mut text, report);
    fits(&mut text, report);
    outliers(&mut text, report);
    next(&mut text, report);
    text
}

fn estimates(text: &mut String, report: &CalibrationReport) {
    if report.parameters.is_empty() {
        return;
    }
    let width = report.parameters.iter().map(|each| each.name.len()).max().unwrap_or(0).max(10);
    let _ = writeln!(text, "\n  {:width$}  {:>23}  {:>23}", "correction", "least squares", report.loss);
    for each in &report.parameters {
        let plain = corrected(each, each.correction, each.standard_deviation);
        let robust = corrected(each, each.robust_correction, each.robust_standard_deviation);
        let mark = if each.significant { "significant" } else { "-" };
        let is_recommended = report.recommended != Recommendation::Nominal;
        let table = each.in_table.as_ref().filter(|_| is_recommended).map_or_else(String::new, |entry| {
            let found = figure(each.unit, entry.found);
            format!(
                "  line {}: {} {} -> {}",
                entry.line,
                key(each.unit, entry.entry),
                found,
                figure(each.unit, entry.corrected)
            )
        });
        let _ = writeln!(text, "  {:width$}  {plain:>23}  {robust:>23}  {mark:11}{table}", each.name);
    }
    let word = match report.recommended {
        Recommendation::Nominal => "none: keep the nominal model",
        Recommendation::LeastSquares => "least squares",
        Recommendation::Robust => "the robust estimate",
    };
    let _ = writeln!(text, "  recommended: {word}");
}

fn corrected(of: &Estimate, value: f64, deviation: f64) -> String {
    let (scale, unit) = handy(of.unit);
    if deviation.is_nan() {
        return format!("{:+.4} ± unknown {unit}", value * scale);
    }
    format!("{:+.4} ± {:.4} {unit}", value * scale, deviation * scale)
}

/// Degrees and millimetres, as a robot file may have them.
fn handy(unit: &str) -> (f64, &'static str) {
    if unit == "rad" { (1f64.to_degrees(), "deg") } else { (1e3, "mm") }
}

fn key(unit: &str, entry: &str) -> String {
    format!("{entry}_{}", handy(unit).1)
}

fn figure(unit: &str, value: f64) -> String {
    format!("{:.4}", value * handy(unit).0)
}

fn fixed(text: &mut String, report: &CalibrationReport) {
    if report.fixed.is_empty() {
        return;
    }
    let _ = writeln!(
        text,
        "\n  fixed at nominal (below {:e} of the largest singular value)",
        report.identifiability.threshold
    );
    let width = report.fixed.iter().map(|each| each.name.len()).max().unwrap_or(0);
    for each in &report.fixed {
        let _ = writeln!(text, "  {:width$}  {}", each.name, each.reason);
    }
}

fn fits(text: &mut String, report: &CalibrationReport) {
    let _ = writeln!(text, "\n  {:16}  {:>20}  {:>20}  cost in m2", "fit", "root mean square", "worst");
    let mut line = |word: &str, left: &Remainder, noise: Option<&Estimation>| {
        let rms = size(left.rms_m, left.rms_rad);
        let worst = size(left.worst_m, left.worst_rad);
        let noise = noise.filter(|of| of.noise_m.is_finite()).map_or_else(String::new, |of| {
            format!(
                "  noise of a component {}",
                size(of.noise_m, if left.worst_rad > 0.0 { of.noise_rad } else { 0.0 })
            )
        });
        let _ = writeln!(text, "  {word:16}  {rms:>20}  {worst:>20}  {:.6e}{noise}", left.cost_m2);
    };
    line("nominal", &report.nominal, None);
    line("least squares", &report.least_squares.left, Some(&report.least_squares));
    line(report.loss, &report.robust.left, Some(&report.robust));
    if let Some(error) = &report.held_out {
        let _ = writeln!(
            text,
            "  held out          {:>20}  ({} parts; nominal on the same rows {})",
            size(error.rms_m, error.rms_rad),
            error.folds,
            size(error.nominal_rms_m, error.nominal_rms_rad)
        );
    }
}

fn outliers(text: &mut String, report: &CalibrationReport) {
    if report.outliers.is_empty() {
        return;
    }
    let _ = writeln!(text, "\n  rows that do not fit: nominal, least squares, {}, weight", report.loss);
    for each in &report.outliers {
        let _ = writeln!(
            text,
            "  row {:4} (line {})  {:>20}  {:>20}  {:>20}  {:.2}",
            each.row,
            each.line,
            size(each.nominal_m, each.nominal_rad),
            size(each.least_squares_m, each.least_squares_rad),
            size(each.robust_m, each.robust_rad),
            each.weight
        );
    }
}

fn next(text: &mut String, report: &CalibrationReport) {
    if report.next.is_empty() {
        return;
    }
    let _ = writeln!(text, "\n  most telling next (within the joint limits; not checked for collisions)");
    for pose in &report.next {
        let _ = writeln!(text, "  {:5.2} bit  {}", pose.gain_bits, pose.q.listed(3));
    }
}

/// A distance, with the angle where orientations were measured.
fn size(metres: f64, radians: f64) -> String {
    let length = if metres >= 1e-6 { format!("{:.4} mm", metres * 1e3) } else { format!("{metres:.1e} m") };
    if radians > 0.0 { format!("{length} {:.5} deg", radians.to_degrees()) } else { length }
}
