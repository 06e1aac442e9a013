//! `calibrate --out`: the corrected robot as a robot file and a URDF beside it.

use std::path::{Path, PathBuf};

use congruent::{
    analysis::conversion::{
        Conversion, ConversionReport, ConversionSource, ConversionTarget, DEFAULT_ACCURACY, Destination,
        RoundedAxes, convert_robot,
    },
    calibration::{
        CorrectedRobot,
        report::{CalibratedFiles, WrittenModel},
    },
    description::{Places, RobotDescription, load_robot_with},
    input::{Diagnostic, FileAccess, is_standard_input},
    kinematics::PoseError,
    text::layout::visible_path,
    writers::{dh_section, own_robot_file_text, poe_section, robot_file_text},
};

use crate::{
    failure::Failure,
    input::allowing_inputs,
    output::{
        file::{NewFile, unwritable},
        folders::Folders,
    },
    terminal::print::Printer,
};

/// The name of the robot file in its folder.
const FILE: &str = "robot.toml";
/// How far the written files may be from the calibrated chain, m and rad. Kind: rounding of the written digits; worst seen 4e-15.
const PROVED: f64 = 1e-9;

/// Where the corrected robot is written.
#[derive(Debug, clap::Args)]
pub(super) struct OutArguments {
    /// Write the robot with the recommended corrections into this folder, which is made if it does not exist: robot.toml, with
    /// the corrected table, or with screws if no table says the corrections, and a URDF with the corrected origins of its joints.
    /// A base that was estimated is a link of its own there, as is a camera, a tool the key tcp. Exit code 1 if no correction is recommended.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace robot.toml and the URDF of --out if they exist.
    #[arg(long, requires = "out")]
    force: bool,
}

/// A calibration whose robot is written.
pub(super) struct Calibrated<'a> {
    pub(super) description: &'a RobotDescription,
    /// The corrected robot; `None` if no correction is recommended.
    pub(super) corrected: &'a dyn Fn() -> Result<Option<CorrectedRobot>, Diagnostic>,
    /// The comments of its robot file, with what is not taken over from the nominal one.
    pub(super) comments: &'a dyn Fn(&[String]) -> String,
    /// The files that were read, which are not replaced.
    pub(super) inputs: &'a [PathBuf],
}

impl OutArguments {
    /// The folder, if there is one.
    pub(super) fn folder(&self) -> Option<&Path> {
        self.out.as_deref()
    }

    /// Refuses before any work what could not be written after it.
    pub(super) fn may_be_written(
        &self,
        description: &RobotDescription,
        inputs: &[PathBuf],
    ) -> Result<(), Diagnostic> {
        let Some(folder) = self.folder() else { return Ok(()) };
        [FILE.to_owned(), urdf_name(description)]
            .iter()
            .try_for_each(|name| self.target(&folder.join(name)).may_be_written(inputs))
    }

    /// What is said where a robot was to be written and none is recommended.
    pub(super) fn nothing_written(&self) -> String {
        self.folder().map_or_else(String::new, |folder| {
            format!("\n  nothing is written to {}: no corrections are recommended\n", visible_path(folder))
        })
    }

    /// Writes both files; `None` if there is no folder, or no correction is recommended. What was there before a refusal is there
    /// again.
    pub(super) fn write(
        &self,
        calibrated: &Calibrated<'_>,
        printer: &Printer,
    ) -> Result<Option<CalibratedFiles>, Failure> {
        let Some(folder) = self.folder() else { return Ok(None) };
        let Some(corrected) = (calibrated.corrected)()? else { return Ok(None) };
        let made = Folders::make(folder)?;
        let written = self.write_into(folder, &corrected, calibrated, printer);
        written.map(Some).inspect_err(|_| made.remove())
    }

    fn write_into(
        &self,
        folder: &Path,
        corrected: &CorrectedRobot,
        calibrated: &Calibrated<'_>,
        printer: &Printer,
    ) -> Result<CalibratedFiles, Failure> {
        let Calibrated { description, inputs, .. } = *calibrated;
        let place = folder.canonicalize().map_err(|error| unwritable(folder, &error))?;
        let (urdf, file) = (folder.join(urdf_name(description)), folder.join(FILE));
        let access = allowing_inputs(FileAccess::default(), description);
        let converted = urdf_of(corrected, &urdf, &access)?;
        printer.warnings(None, &converted.findings);
        let model = if corrected.description.dh.is_some() { WrittenModel::Dh } else { WrittenModel::Poe };
        let left_out = left_out(description, model);
        let toml = (calibrated.comments)(&left_out) + &robot_file(corrected, &place, &urdf_name(description));
        let tree = converted.urdf.unwrap_or_default();
        // The robot file is written while the URDF may still be taken back: neither is left without the other.
        let proof = self.target(&urdf).write(&tree, inputs, |urdf| {
            self.target(&file).write(&toml, inputs, |file| proved(corrected, file, urdf, &access))
        })?;
        let base = &corrected.description.robot.link(corrected.description.base).name;
        Ok(CalibratedFiles {
            robot_file: file.display().to_string(),
            urdf: urdf.display().to_string(),
            model,
            beyond_the_table: corrected.beyond_the_table.clone(),
            base_link: corrected.measured_from_base.map(|_| base.clone()),
            camera_link: corrected.camera_link.clone(),
            has_corrected_tcp: corrected.has_other_tool,
            left_out,
            position_m: proof.position_m,
            orientation_rad: proof.orientation_rad,
        })
    }

    fn target<'a>(&self, path: &'a Path) -> NewFile<'a> {
        NewFile { option: "--out", path, force: self.force }
    }
}

/// The name of the written URDF: that of the nominal one, or of the robot file that is a robot by itself.
fn urdf_name(description: &RobotDescription) -> String {
    let path = &description.urdf_path;
    let stem = path.file_stem().filter(|_| !is_standard_input(path));
    format!("{}.urdf", stem.map_or("robot".into(), |stem| stem.to_string_lossy()))
}

/// The whole tree as URDF. Table, tool and what else a URDF has no place for are in the robot file, or reported as left out.
fn urdf_of(
    corrected: &CorrectedRobot,
    path: &Path,
    access: &FileAccess,
) -> Result<ConversionReport, Diagnostic> {
    let tree = RobotDescription {
        dh: None,
        dynamics: None,
        tip_from_tcp: None,
        accelerations: Vec::new(),
        disabled_collisions: std::collections::BTreeSet::default(),
        ..corrected.description.clone()
    };
    let conversion = Conversion {
        from: Some(ConversionSource::Urdf),
        to: ConversionTarget::Urdf,
        accuracy: DEFAULT_ACCURACY,
        seed: 0,
        rounded_axes: RoundedAxes::Kept,
    };
    convert_robot(&tree, &conversion, Destination { path, access })
}

/// The robot file in `folder`: the corrected table with the URDF, or the corrected screws, compared with the URDF as a reference.
fn robot_file(corrected: &CorrectedRobot, folder: &Path, urdf: &str) -> String {
    let mut description = corrected.description.clone();
    description.urdf_path = folder.join(urdf);
    let srdf = description.named_files.srdf.take();
    description.named_files.srdf = srdf.map(|srdf| srdf.canonicalize().unwrap_or(srdf));
    // Meshes of the new URDF are relative to it.
    description.named_files.packages.clear();
    // Also of a robot without a URDF the new file has one.
    description.places = Places::default();
    if let Some(table) = &description.dh {
        let section = dh_section(table, &description.robot);
        return robot_file_text(&description, &section, folder, description.tolerance);
    }
    let chain = &corrected.chain_to_tip;
    let twists: Vec<_> = chain.twists_in_base.iter().map(|twist| [twist.angular, twist.linear]).collect();
    let home = chain.base_from_tip_at_zero.to_isometry();
    let section = poe_section(&description.moving_chain(), &twists, &home, &description.robot);
    let urdf = congruent::input::toml_string(urdf);
    own_robot_file_text(&description, &section) + &format!("\n[[reference]]\nfile = {urdf}\n")
}

/// What the nominal robot file declares and the written one does not have.
fn left_out(description: &RobotDescription, model: WrittenModel) -> Vec<String> {
    let has_srdf = description.named_files.srdf.is_some() && model == WrittenModel::Poe;
    let declared = [
        (has_srdf, "srdf"),
        (description.dynamics.is_some(), "[[inertial]]"),
        (description.accelerations.iter().any(Option::is_some), "accelerations of [limits]"),
        (description.mapping.is_some(), "[mapping]"),
        (!description.references.is_empty(), "[[reference]]"),
    ];
    declared.into_iter().filter(|(is_declared, _)| *is_declared).map(|(_, key)| key.to_owned()).collect()
}

/// Reads both files again: the model of the robot file and the URDF are the calibrated chain.
fn proved(
    corrected: &CorrectedRobot,
    file: &Path,
    urdf: &Path,
    access: &FileAccess,
) -> Result<PoseError, Failure> {
    let nominal = &corrected.description;
    let name = |link| nominal.robot.link(link).name.as_str();
    let by_model = load_robot_with(file, access)?;
    let by_urdf =
        load_robot_with(urdf, access)?.with_chain(Some(name(nominal.base)), Some(name(nominal.tip)))?;
    let by_urdf = RobotDescription { tip_from_tcp: nominal.tip_from_tcp, ..by_urdf };
    let of_model = corrected.largest_difference(&by_model, 0)?;
    let proof = of_model.larger(corrected.largest_difference(&by_urdf, 0)?);
    if proof.position_m <= PROVED && proof.orientation_rad <= PROVED {
        return Ok(proof);
    }
    let message = format!(
        "the written robot differs from the calibrated one by {:e} m and {:e} rad (limit {PROVED:e})",
        proof.position_m, proof.orientation_rad
    );
    Err(Diagnostic::error(congruent::calibration::codes::calibrate::UNPROVED, message)
        .with_help("nothing is written; this is a fault of Congruent, please report it with both files")
        .into())
}
