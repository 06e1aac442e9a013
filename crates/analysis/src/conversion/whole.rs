//! Whole robots as URDF and MJCF, proved by reading the text again.

use std::path::Path;

use congruent_description::RobotDescription;
use congruent_input::{Diagnostic, Findings, folder_of};
use congruent_writers::{ReadBack, RobotFormat, read_back, robot_text};

use super::{
    converted_model::ConvertedModel,
    options::{Conversion, ConversionSource, ConversionTarget, Destination},
    report::{ConversionReport, ProofReport},
};
use crate::codes;

/// Writes the whole robot of a description, whatever its table says, for a file at `destination`, to which its meshes are relative. The
/// text is read back and compared with the robot; nothing is written to the file.
///
/// # Errors
/// The format cannot hold the robot, or the text gives another robot when it is read again.
pub fn convert_robot(
    description: &RobotDescription,
    conversion: &Conversion,
    destination: Destination<'_>,
) -> Result<ConversionReport, Diagnostic> {
    let format = match conversion.to {
        ConversionTarget::Mjcf => RobotFormat::Mjcf,
        _ => RobotFormat::Urdf,
    };
    let model = ConvertedModel::new(description, Some(ConversionSource::Urdf))?;
    let mut report = ConversionReport::new(&model, conversion);
    // Notes are of the chain, of which nothing is written here.
    report.notes.clear();
    let written = robot_text(description, format, &absolute_folder(destination.path)?)?;
    let how = ReadBack {
        path: destination.path,
        access: destination.access,
        limit: conversion.accuracy,
        seed: conversion.seed,
    };
    let (found, proof) = read_back(&written, how).map_err(Findings::into_first)?;
    report.proof = ProofReport::new(&proof, conversion);
    report.read_back = Some(found);
    report.joints = description.robot.movable_joint_names().map(str::to_owned).collect();
    written.warnings.into_iter().for_each(|warning| report.warn(warning));
    match format {
        RobotFormat::Urdf => report.urdf = Some(written.text),
        RobotFormat::Mjcf => report.mjcf = Some(written.text),
    }
    Ok(report)
}

/// The folder of a file as meshes are relative to it: absolute, without links.
fn absolute_folder(path: &Path) -> Result<std::path::PathBuf, Diagnostic> {
    folder_of(path).canonicalize().map_err(|error| {
        let message = format!("the folder of {} cannot be read: {error}", path.display());
        Diagnostic::error(codes::convert::WHOLE, message).with_help("choose a file in a folder that exists")
    })
}
