//! Errors with the covariance of a calibration: what `congruent calibrate --format json` has printed.

use std::collections::BTreeMap;

use congruent_calibration::estimation::{base_pose, joint_axes, tool_pose, zero_offsets};
use congruent_description::RobotDescription;
use congruent_input::{Diagnostic, SourceFile, display::first_of, known_names};
use nalgebra::DMatrix;
use serde::Deserialize;

use crate::{
    codes,
    parameters::{NominalModel, ToleratedChain},
    spread::ErrorSpread,
};

/// Standard deviations that count as the tolerance of an estimate.
const SIGMAS: f64 = 3.0;

/// The parts of the report of a calibration that are needed.
#[derive(Debug, Deserialize)]
struct PrintedCalibration {
    robot: String,
    parameters: Vec<PrintedCorrection>,
    covariance: Vec<Vec<Option<f64>>>,
    #[serde(default)]
    fixed: Vec<PrintedFixed>,
}

/// A correction that the measurements do not identify.
#[derive(Debug, Deserialize)]
struct PrintedFixed {
    name: String,
    /// Estimated corrections that have the same effect; none if no measurement shows it.
    correlated_with: BTreeMap<String, f64>,
}

/// Whether a correction is of the camera that has measured, and so of no part of the robot.
fn is_of_camera(name: &str) -> bool {
    ["camera.", "target."].iter().any(|frame| name.starts_with(frame))
}

#[derive(Debug, Deserialize)]
struct PrintedCorrection {
    name: String,
}

impl PrintedCalibration {
    /// The covariance of all corrections.
    fn covariance(&self) -> Option<DMatrix<f64>> {
        let count = self.parameters.len();
        let is_square =
            self.covariance.len() == count && self.covariance.iter().all(|row| row.len() == count);
        let values: Option<Vec<f64>> = self.covariance.iter().flatten().copied().collect();
        let values = values.filter(|_| is_square && count > 0)?;
        values.iter().all(|value| value.is_finite()).then(|| DMatrix::from_row_slice(count, count, &values))
    }
}

/// The chain whose parameters have the covariance of a calibration's estimates.
///
/// Poses of a camera and of its target move no tool, so that their rows and columns are left out.
///
/// # Errors
/// The text is no report of a calibration of this robot, or it has no covariance.
pub fn calibrated(description: &RobotDescription, source: &SourceFile) -> Result<ToleratedChain, Diagnostic> {
    let refused = |message: String| Diagnostic::error(codes::tolerances::CALIBRATION, message);
    let path = source.path.display();
    let help = format!(
        "congruent calibrate {} MEASUREMENTS.csv --format json > calibration.json",
        description.path.display()
    );
    let printed: PrintedCalibration = serde_json::from_str(&source.text).map_err(|error| {
        refused(format!("{path} is not the report of a calibration: {error}")).with_help(help.clone())
    })?;
    if printed.robot != description.name {
        let message =
            format!("{path} is of robot \"{}\", and this is \"{}\"", printed.robot, description.name);
        return Err(refused(message).with_help("give the robot that was calibrated"));
    }
    let Some(covariance) = printed.covariance() else {
        let message = format!("{path} has no covariance: too few measurements to estimate the noise");
        return Err(refused(message)
            .with_help("measure more configurations, or state the noise: calibrate --noise 0.1mm"));
    };
    if !is_covariance(&covariance) {
        let message =
            format!("the covariance of {path} is none: it is not symmetric, or a variance is negative");
        return Err(refused(message).with_help(help));
    }
    let model = NominalModel::new(description)?;
    let names = model.joint_names();
    let mut known = base_pose();
    known.extend(zero_offsets(&model.chain, &names));
    known.extend(match &model.dh {
        Some(_) => model.entries(&names)?,
        None => joint_axes(&model.chain, &names),
    });
    known.extend(tool_pose(&model.chain));
    // Of each correction its place among the known ones, in whose order the corrections of one slot act, and its column.
    let mut placed: Vec<(usize, usize)> = Vec::new();
    for (column, PrintedCorrection { name }) in printed.parameters.iter().enumerate() {
        if is_of_camera(name) {
            continue;
        }
        let Some(place) = known.iter().position(|correction| correction.name == *name) else {
            let all = known.iter().map(|correction| correction.name.as_str());
            return Err(refused(format!("{path}: this robot has no correction \"{name}\""))
                .with_help(known_names(name, "corrections", all)));
        };
        placed.push((place, column));
    }
    placed.sort_by_key(|&(place, _)| place);
    let columns: Vec<usize> = placed.iter().map(|&(_, column)| column).collect();
    let covariance = covariance.select_rows(&columns).select_columns(&columns);
    let corrections = placed.iter().map(|&(place, _)| known[place].clone()).collect();
    let mut chain = model.with_spread(corrections, ErrorSpread::of_covariance(&covariance, SIGMAS));
    chain.warnings = not_identified(&printed.fixed, source);
    Ok(chain)
}

/// Whether a matrix is symmetric, and no combination of corrections has a negative variance, up to rounding.
fn is_covariance(of: &DMatrix<f64>) -> bool {
    /// Relative to the largest variance. Kind: rounding of printed numbers.
    const ROUNDING: f64 = 1e-9;
    // In units of the standard deviations: a length has another unit than an angle.
    let deviation = |at: usize| of[(at, at)].sqrt();
    let scaled = DMatrix::from_fn(of.nrows(), of.ncols(), |row, column| {
        let scale = deviation(row) * deviation(column);
        if scale > 0.0 { of[(row, column)] / scale } else { of[(row, column)] }
    });
    let is_symmetric = (&scaled - scaled.transpose()).amax() <= ROUNDING;
    let smallest = || scaled.clone().symmetric_eigenvalues().min();
    of.diagonal().iter().all(|variance| *variance >= 0.0) && is_symmetric && smallest() >= -ROUNDING
}

/// A warning of corrections of which the measurements say nothing.
fn not_identified(fixed: &[PrintedFixed], source: &SourceFile) -> Vec<Diagnostic> {
    /// Names that are listed.
    const LISTED: usize = 6;
    let unseen = fixed.iter().filter(|of| of.correlated_with.is_empty() && !is_of_camera(&of.name));
    let names: Vec<&str> = unseen.map(|of| of.name.as_str()).collect();
    if names.is_empty() {
        return Vec::new();
    }
    let message = format!(
        "the measurements of {} say nothing of {}, which count as exact",
        source.path.display(),
        first_of(&names, LISTED)
    );
    let warning = Diagnostic::warning(codes::tolerances::CALIBRATION, message);
    vec![warning.with_help("measure more configurations, or give their tolerances by [tolerances] instead")]
}
