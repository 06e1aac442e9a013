//! `congruent calibrate`: corrections of a robot from measurements.

#![expect(clippy::doc_markdown, reason = "the comments are printed as help, where backticks are noise")]

use std::path::PathBuf;

use congruent::{
    calibration::{
        CalibrationOptions, Loss, Noise, calibrate,
        measurements::{MeasuredRow, read_measurements},
        needed_coordinates,
        report::{CalibrationVerdict, plot},
    },
    input::{Diagnostic, units::Unit},
    page::calibration_page,
    text::calibration_text,
};

use crate::{
    codes,
    failure::{FAILED, Failure, NOTHING},
    input::{ArmArguments, files_of, named},
    output::{file::refuse_same, page::PageArgument, plot::PlotArgument},
    terminal::{print::Printer, progress::waiting},
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
    printer.result(&report, |report| calibration_text(report, &description.robot))?;
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
            Err(Diagnostic::error(codes::cli::VALUE, format!("--{name} {value} is not a positive number")))
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
                return Err(Diagnostic::error(
                    codes::cli::NOISE,
                    "only one of --noise-mm and --noise-deg is given",
                )
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
