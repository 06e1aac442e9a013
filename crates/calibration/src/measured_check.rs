//! `congruent check --measurements`: whether the model is the measured robot, within a tolerance.

use std::path::Path;

use congruent_description::{JointValues, ReportedChain, RequestedTolerance, RobotDescription};
use congruent_input::{Diagnostic, Finding};
use schemars::JsonSchema;
use serde::Serialize;

use crate::{
    camera::{CameraMount, may_be_seen, measured_frame},
    camera_frames::{CameraEstimate, CameraFrames},
    chain::NominalChain,
    codes,
    computed::measurement,
    estimation::{
        CorrectedChain, FixedParameter, Identification, Loss, Measurement, ParameterUnit, PoseResidual,
        Problem, align, fit_robustly, fit_with_estimated_noise, identify,
    },
    free,
    measurements::MeasuredRow,
    report::{CalibratedModel, ResidualSummary, residual_summary::summary},
};

/// Options of a comparison with measurements.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredCheckOptions {
    /// How far a measured row may be off: a part for each of position and orientation that was measured.
    pub tolerance: RequestedTolerance,
    /// Corrections of base and tool that are fitted before, by group or name; none by default.
    pub free: Vec<String>,
    /// Where the camera is, if one measured the rows: then `base` and `tool` are the poses of camera and target.
    pub camera: Option<CameraMount>,
    /// Smallest singular value of the fitted corrections over the largest of all. No unit.
    pub threshold: f64,
}

/// The answer of `congruent check --measurements`. Metres and radians throughout.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct MeasuredCheck {
    /// Name of the robot.
    pub robot: String,
    /// Its file, as it was named.
    pub file: String,
    /// The file of the measurements, as it was named.
    pub measurements: String,
    /// Base and tip, and who named them.
    pub chain: ReportedChain,
    /// The model that is compared.
    pub model: CalibratedModel,
    /// The frame whose pose was measured: a link's name, `tcp`, or `target` if a camera measured it.
    pub measured_frame: String,
    /// Whether every row is within the tolerance.
    pub verdict: MeasuredVerdict,
    /// The tolerance of each row.
    pub tolerance: RequestedTolerance,
    /// Number of measured rows.
    pub rows: usize,
    /// Number of rows beyond the tolerance.
    pub rows_beyond: usize,
    /// Differences of all rows.
    pub differences: ResidualSummary,
    /// The row that is furthest off, measured by the tolerance.
    pub worst: MeasuredDifference,
    /// Its joint positions, rad or m.
    pub worst_q: JointValues,
    /// The corrections of base and tool that were fitted before the comparison; none without `--free`.
    pub fitted: Vec<FittedCorrection>,
    /// Every row.
    pub row_differences: Vec<MeasuredDifference>,
    /// Camera and target as they were fitted; left out if no camera measured the rows.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera: Option<CameraFrames>,
    /// Warnings about the input.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Finding>,
}

/// Whether the model is the measured robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MeasuredVerdict {
    /// Every row is within the tolerance.
    Agree,
    /// Some row is beyond it.
    Disagree,
}

/// The difference of one row.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct MeasuredDifference {
    /// Number of the measurement, from 1.
    pub row: usize,
    /// Line in the file.
    pub line: usize,
    /// Distance of measured and modelled position over the measured coordinates, m.
    pub position_m: f64,
    /// Angle between measured and modelled orientation, rad; 0 if none was measured.
    pub orientation_rad: f64,
    /// The larger of the two over its tolerance.
    pub excess: f64,
    /// Whether it is beyond the tolerance.
    pub is_beyond: bool,
}

/// A fitted correction of base or tool.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FittedCorrection {
    /// `base.<axis>` or `tool.<axis>`.
    pub name: String,
    /// Unit of the value.
    pub unit: ParameterUnit,
    /// Its value, in `unit`.
    pub value: f64,
    /// Whether the measurements identify it; otherwise it is held where the other values need it.
    pub is_identified: bool,
}

/// Compares a robot's model (its table if there is one, otherwise its URDF) with measured poses or points of its tip.
///
/// `measurements` is the name of the file, for the answer.
///
/// # Errors
/// The robot has no chain, a part of the tolerance is missing, `free` names a correction of the arm, or the rows are too few to
/// fit the frames and to compare.
pub fn check_measured(
    description: &RobotDescription,
    measurements: &Path,
    rows: &[MeasuredRow],
    options: &MeasuredCheckOptions,
) -> Result<MeasuredCheck, Diagnostic> {
    may_be_seen(rows, options.camera)?;
    let nominal = NominalChain::new(description)?;
    let measured: Vec<Measurement> =
        rows.iter().map(|row| measurement(&nominal, row, options.camera)).collect();
    judged_parts(&measured, options.tolerance)?;
    let chain = of_frames(&nominal, options)?;
    let FittedFrames { corrections, kept, fixed } = fitted(&chain, &measured, options.threshold)?;
    let residuals = Problem { chain: &chain, measurements: &measured }.residuals(&corrections);
    let row_differences: Vec<MeasuredDifference> = residuals
        .iter()
        .enumerate()
        .map(|(at, residual)| difference(at, rows, residual, options.tolerance))
        .collect();
    let worst = row_differences.iter().max_by(|a, b| a.excess.total_cmp(&b.excess));
    let worst =
        *worst.ok_or_else(|| Diagnostic::error(codes::measurements::NONE, "there is no measurement"))?;
    let rows_beyond = row_differences.iter().filter(|row| row.is_beyond).count();
    let fitted = chain.parameters().iter().enumerate().map(|(at, parameter)| FittedCorrection {
        name: parameter.name.clone(),
        unit: parameter.unit(),
        value: corrections[at],
        is_identified: kept.contains(&at),
    });
    let camera = options.camera.map(|mount| {
        let estimate = CameraEstimate {
            mount,
            description,
            nominal: &nominal,
            chain: &chain,
            corrections: &corrections,
            covariance: None,
            fixed: &fixed,
            has_orientation: rows.iter().any(|row| row.orientation.is_some()),
        };
        estimate.frames()
    });
    Ok(MeasuredCheck {
        robot: description.name.clone(),
        file: description.path.display().to_string(),
        measurements: measurements.display().to_string(),
        chain: description.reported_chain(),
        model: if nominal.table.is_some() { CalibratedModel::Dh } else { CalibratedModel::Urdf },
        measured_frame: measured_frame(description, options.camera),
        verdict: if rows_beyond == 0 { MeasuredVerdict::Agree } else { MeasuredVerdict::Disagree },
        tolerance: options.tolerance,
        rows: rows.len(),
        rows_beyond,
        differences: summary(&residuals),
        worst,
        worst_q: JointValues::for_movable_joints(&description.robot, &rows[worst.row - 1].q),
        fitted: fitted.collect(),
        row_differences,
        camera,
        warnings: description.warnings.iter().map(Finding::from).collect(),
    })
}

/// What was measured must be judged: without a tolerance for angles, any orientation would agree.
fn judged_parts(measured: &[Measurement], tolerance: RequestedTolerance) -> Result<(), Diagnostic> {
    let has_position = measured.iter().any(|each| each.position_count() > 0);
    let has_orientation = measured.iter().any(|each| each.orientation_count() > 0);
    let lacks_length = has_position && tolerance.position_m.is_none();
    let lacks_angle = has_orientation && tolerance.orientation_rad.is_none();
    let (what, example) = match (lacks_length, lacks_angle) {
        (false, false) => return Ok(()),
        (true, true) => ("positions and orientations", "--tolerance 1mm,0.1deg"),
        (true, false) if has_orientation => ("positions", "the length too, as in --tolerance 1mm,0.1deg"),
        (true, false) => ("positions", "--tolerance 1mm"),
        (false, true) if has_position => ("orientations", "the angle too, as in --tolerance 1mm,0.1deg"),
        (false, true) => ("orientations", "--tolerance 0.1deg"),
    };
    let message = format!("the file has measured {what}, and no tolerance says how far they may be off");
    Err(Diagnostic::error(codes::measured_check::TOLERANCE, message).with_help(format!(
        "write {example}, from the accuracy of arm and instrument: measured values never agree to the digits of a model"
    )))
}

/// The chain with the corrections of base and tool that are free; with none it is the nominal one.
fn of_frames(
    nominal: &NominalChain<'_>,
    options: &MeasuredCheckOptions,
) -> Result<CorrectedChain, Diagnostic> {
    let parameters =
        if options.free.is_empty() { Vec::new() } else { free::parameters(nominal, &options.free, &[])? };
    if let Some(of_arm) = parameters.iter().find(|parameter| !parameter.entry.is_of_frame()) {
        let message = format!("--free {} would fit the arm, which is to be compared", of_arm.name);
        return Err(Diagnostic::error(codes::measured_check::ARM, message)
            .with_help("free base and tool alone; `congruent calibrate` fits the arm to the measurements"));
    }
    Ok(CorrectedChain::new(nominal.chain.clone(), parameters))
}

/// Base and tool as they were fitted.
#[derive(Debug, Default)]
struct FittedFrames {
    corrections: Vec<f64>,
    kept: Vec<usize>,
    fixed: Vec<FixedParameter>,
}

/// The corrections of base and tool, and which of them are identified. They are fitted robustly: a row that is off must not hide
/// in the frames.
fn fitted(
    chain: &CorrectedChain,
    measured: &[Measurement],
    threshold: f64,
) -> Result<FittedFrames, Diagnostic> {
    if chain.parameters().is_empty() {
        return Ok(FittedFrames::default());
    }
    let chain = align(chain, measured, threshold);
    let problem = Problem { chain: &chain, measurements: measured };
    let Identification { kept, fixed, .. } = identify(&problem, threshold);
    if problem.redundancy(&kept) == 0 {
        let message =
            "the measurements are too few to fit base and tool and to compare: any arm would agree with them";
        return Err(Diagnostic::error(codes::measured_check::TOO_FEW, message).with_help(
            "measure at more configurations, or free less: --free base, or none if the model has both",
        ));
    }
    let plain = fit_with_estimated_noise(&problem, &kept);
    let robust = fit_robustly(&problem, &kept, Loss::Tukey, &plain, None);
    let is_most = 2 * robust.outliers.len() > measured.len();
    let best = if robust.outliers.is_empty() || is_most { plain } else { robust.fit };
    Ok(FittedFrames { corrections: best.corrections, kept, fixed })
}

fn difference(
    at: usize,
    rows: &[MeasuredRow],
    residual: &PoseResidual,
    tolerance: RequestedTolerance,
) -> MeasuredDifference {
    let (position_m, orientation_rad) = (residual.position_m.norm(), residual.orientation_rad.norm());
    let excess = excess(position_m, orientation_rad, tolerance);
    let (row, line) = (at + 1, rows[at].line);
    MeasuredDifference { row, line, position_m, orientation_rad, excess, is_beyond: excess > 1.0 }
}

/// How many times the tolerance a row is off, in position or in orientation.
fn excess(position_m: f64, orientation_rad: f64, tolerance: RequestedTolerance) -> f64 {
    // A part without a tolerance was not measured: its difference is 0.
    let share = |value: f64, most: Option<f64>| most.map_or(0.0, |most| value / most);
    share(position_m, tolerance.position_m).max(share(orientation_rad, tolerance.orientation_rad))
}
