//! Errors with the covariance of a calibration: what `congruent calibrate --format json` has printed.

use congruent_calibration::estimation::{base_pose, joint_axes, tool_pose, zero_offsets};
use congruent_description::RobotDescription;
use congruent_input::{Diagnostic, SourceFile, known_names};
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
        if ["camera.", "target."].iter().any(|frame| name.starts_with(frame)) {
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
    Ok(model.with_spread(corrections, ErrorSpread::of_covariance(&covariance, SIGMAS)))
}
