//! `congruent calibrate`: corrections of a robot from measurements.

#![expect(clippy::doc_markdown, reason = "the comments are printed as help, where backticks are noise")]

use std::path::{Path, PathBuf};

use congruent::{
    calibration::{
        CalibrationOptions, Loss, Noise, calibrate, corrected_robot,
        measurements::{MeasuredRow, read_measurements},
        needed_coordinates,
        report::{CalibrationVerdict, plot},
    },
    input::{Diagnostic, FileAccess, InputFile, is_standard_input},
    page::{CalibrationSource, calibration_page},
    text::{calibrated_robot_comments, calibration_text},
};

use crate::{
    codes,
    failure::{FAILED, Failure, NOTHING},
    input::{ArmArguments, files_of, named, seed},
    invocation,
    model::{
        calibrated_robot::{Calibrated, OutArguments},
        camera::CameraArgument,
        same_point::SamePointArguments,
    },
    output::{file::refuse_same, page::PageArgument, plot::PlotArgument},
    terminal::{print::Printer, progress::waiting},
    tolerance::ToleranceArgument,
};

/// Corrections of a robot's model from measured poses or points of its tip (or TCP) in the base.
///
/// MEASUREMENTS is CSV with a header (`<joint>_rad` or `_deg`, then x_m, y_m, z_m or _mm, optionally qw, qx, qy,
/// qz or roll_deg, pitch_deg, yaw_deg or a rotation vector rx_rad, ry_rad, rz_rad), or JSON: [{"q": {joint: rad}, "translation_m": [x, y, z],
/// "quaternion_wxyz": [w, x, y, z]}]. Coordinates that were not measured are left out. Measurements count
/// from 1, in the order of the file.
///
/// Exit code 1 if the corrections do not explain the measurements (the residual is too large for noise, or for
/// the stated noise, the file is likely meant in other units, another order or frame, or a length would have to
/// change by more than a tenth of the reach), 4 if no correction
/// can be identified, the corrections cannot be verified, or a camera is not determined.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: ArmArguments,
    /// CSV or JSON file of joint positions and measured poses or points, or - for standard input.
    #[arg(required_unless_present = "same_point")]
    measurements: Option<PathBuf>,
    #[command(flatten)]
    same_point: SamePointArguments,
    #[command(flatten)]
    camera: CameraArgument,
    /// Corrections that are estimated: zero-offsets, dh, axes, base, tool, all, or single corrections such as
    /// elbow_joint.zero, elbow_joint.a, base.yaw; may be given several times.
    /// Without it zero-offsets, or with --camera the poses of camera and target alone.
    #[arg(long, value_delimiter = ',')]
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
    /// Known noise of one measured coordinate, and of one component of a measured orientation: 0.1mm, or 0.1mm,0.05deg.
    /// Without it, it is estimated.
    #[arg(long, value_name = "LENGTH,ANGLE", allow_hyphen_values = true)]
    noise: Option<ToleranceArgument>,
    /// Number of configurations that are suggested for the next measurements, at most 400.
    #[arg(long, default_value_t = 5)]
    next: usize,
    // The cost over the most significant correction, and the residual of each row.
    #[command(flatten)]
    plot: PlotArgument,
    #[command(flatten)]
    page: PageArgument,
    #[command(flatten)]
    out: OutArguments,
    /// Seed of the random configurations of which the most informative are chosen.
    #[arg(long, default_value_t = 0, value_parser = seed)]
    seed: u64,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let description = arguments.arm.load(printer)?;
    let measurements = match &arguments.measurements {
        Some(measurements) if !arguments.same_point.is_given() => measurements,
        _ => {
            let options = arguments.options(&[])?;
            return arguments.same_point.run(&description, &options, &arguments.out, printer);
        }
    };
    let needed = needed_coordinates(&description)?;
    let rows = read_measurements(measurements, &description.robot, &needed)?;
    let options = arguments.options(&rows)?;
    let mut inputs = files_of(&description);
    inputs.push(measurements.clone());
    arguments.plot.is_none_of(&inputs)?;
    arguments.page.is_none_of(&inputs)?;
    refuse_same(arguments.plot.output().into_iter().chain(arguments.page.output()))?;
    arguments.out.may_be_written(&description, &inputs)?;
    let mut report = waiting(printer, "calibrating", || calibrate(&description, &rows, &options))?;
    let read = read_file(measurements);
    let calibrated = Calibrated {
        description: &description,
        corrected: &|| corrected_robot(&description, &options, &report),
        comments: &|left_out| calibrated_robot_comments(&report, read.as_ref(), left_out),
        inputs: &inputs,
    };
    // The estimate is printed also where its robot cannot be written.
    let (written, refused) = match arguments.out.write(&calibrated, printer) {
        Ok(written) => (written, None),
        Err(refused) => (None, Some(refused)),
    };
    report.written = written;
    let is_unwritten = arguments.out.folder().is_some() && report.written.is_none() && refused.is_none();
    printer.result(&report, |report| {
        let text = calibration_text(report, &description.robot);
        if is_unwritten { text + &arguments.out.nothing_written() } else { text }
    })?;
    if let Some(refused) = refused {
        return Err(refused);
    }
    let plotted = arguments.plot.write(|| plot::svg(&report), &inputs);
    let page = || {
        let (command, measurements) = (invocation::command(), read.clone());
        calibration_page(&report, &description, &CalibrationSource { command, measurements })
    };
    arguments.page.write(page, &inputs).and(plotted)?;
    let code = exit_code(report.verdict);
    // A robot that was to be written is not there.
    Ok(if is_unwritten && code == 0 { FAILED } else { code })
}

fn exit_code(verdict: CalibrationVerdict) -> u8 {
    match verdict {
        CalibrationVerdict::Explained
        | CalibrationVerdict::UnexplainedRows
        | CalibrationVerdict::NoImprovement => 0,
        CalibrationVerdict::Unexplained
        | CalibrationVerdict::Misinterpreted
        | CalibrationVerdict::TooLarge
        | CalibrationVerdict::NoiseExceeded => FAILED,
        CalibrationVerdict::CameraUndetermined
        | CalibrationVerdict::Unverifiable
        | CalibrationVerdict::NothingIdentified => NOTHING,
    }
}

/// The file with its digest; standard input has been read and is none.
fn read_file(path: &Path) -> Option<InputFile> {
    let access = FileAccess::default();
    let _ = (!is_standard_input(path)).then(|| access.read_named_text(path, u64::MAX));
    access.files().pop()
}

impl Arguments {
    /// The free corrections by group and name.
    fn free(&self) -> Vec<String> {
        if self.free.is_empty() && self.camera.mount().is_none() {
            return CalibrationOptions::default().free;
        }
        self.camera.free(&self.free)
    }

    fn options(&self, rows: &[MeasuredRow]) -> Result<CalibrationOptions, Diagnostic> {
        let has_orientation = rows.iter().any(|row| row.orientation.is_some());
        if !(self.threshold.is_finite() && self.threshold > 0.0) {
            let message = format!("--threshold {} is not a positive number", self.threshold);
            return Err(Diagnostic::error(codes::cli::VALUE, message));
        }
        let noise = match self.noise.map(ToleranceArgument::parts) {
            None => None,
            // Without measured orientations their noise is of no use.
            Some((Some(position_m), None)) if !has_orientation => {
                Some(Noise { position_m, orientation_rad: 1.0 })
            }
            Some((Some(position_m), Some(orientation_rad))) => Some(Noise { position_m, orientation_rad }),
            Some(_) => {
                let message = "--noise has only one of a length and an angle, and both are measured";
                return Err(Diagnostic::error(codes::cli::NOISE, message)
                    .with_help("for example --noise 0.1mm,0.05deg"));
            }
        };
        Ok(CalibrationOptions {
            free: self.free(),
            hold: self.hold.clone(),
            camera: self.camera.mount(),
            loss: self.loss,
            threshold: self.threshold,
            noise,
            suggestions: self.next,
            seed: self.seed,
        })
    }
}
