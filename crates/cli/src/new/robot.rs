//! `congruent new robot`: a robot file for a URDF.

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use congruent::{
    RobotCheck,
    agreement::compare::{Agreement, CheckOptions},
    analysis::conversion::ConversionTarget,
    description::{RobotDescription, load_robot_with},
    input::{Capability, Diagnostic, Finding, is_standard_input},
    starter::{NewRobot, RobotFileDraft, robot_file},
    text::new_robot_text,
};

use crate::{
    codes,
    failure::{FAILED, Failure, NOTHING},
    input::{ArmArguments, allowing_inputs, files_of, needs_to_be_allowed},
    output::{
        file::{NewFile, unwritable},
        folders::Folders,
    },
    terminal::print::Printer,
};

/// A commented robot file for a URDF, with a derived table.
///
/// Writes robot.toml into a folder, which is made if it does not exist. Base and tip are chosen, unless --base and --tip name
/// them, and the file says why. It refers to the URDF by a relative path: nothing is copied, so the meshes are found
/// where they are. If no table exists for the chain, the file has none and says why. The written file is checked as `check`
/// does: exit code 1 if that disagrees, 4 if there is nothing to compare.
#[derive(Debug, clap::Args)]
// Of a folder or a robot file nothing would be new, and standard input has no path that the new file could name.
#[command(mut_arg("robot", |robot| robot.help("The file of the URDF or MJCF that robot.toml names")))]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: ArmArguments,
    /// The folder of the robot file.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Which equation the rows of the table stand for.
    #[arg(long, value_enum, default_value_t = ConventionArgument::Standard)]
    convention: ConventionArgument,
    /// Replace robot.toml if it exists.
    #[arg(long)]
    force: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum ConventionArgument {
    /// Rz(theta) Tz(d) Tx(a) Rx(alpha).
    Standard,
    /// Rx(alpha) Tx(a) Rz(theta) Tz(d) (Craig).
    Modified,
}

pub(super) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let path = &arguments.arm.robot.robot;
    is_urdf(path)?;
    let description = arguments.arm.load(printer)?;
    target(arguments, &arguments.out.join(FILE)).may_be_written(&files_of(&description))?;
    let to = match arguments.convention {
        ConventionArgument::Standard => ConversionTarget::Standard,
        ConventionArgument::Modified => ConversionTarget::Modified,
    };
    let made = Folders::make(&arguments.out)?;
    let mut report = written(arguments, &description, to).inspect_err(|_| made.remove())?;
    if let Some(warning) =
        needs_to_be_allowed(&arguments.arm.robot.access()?, &arguments.out.join(FILE), path)
    {
        printer.warnings(None, std::slice::from_ref(&warning));
        report.warnings.push(Finding::from(&warning));
    }
    printer.result(&report, new_robot_text)?;
    Ok(match report.verdict {
        Agreement::Agree => 0,
        Agreement::Disagree => FAILED,
        Agreement::NothingCompared => NOTHING,
    })
}

/// The name of the file in its folder.
const FILE: &str = "robot.toml";

fn target<'a>(arguments: &Arguments, path: &'a Path) -> NewFile<'a> {
    NewFile { option: "--out", path, force: arguments.force }
}

/// Writes the file into its folder, which exists, and checks it.
fn written(
    arguments: &Arguments,
    description: &RobotDescription,
    to: ConversionTarget,
) -> Result<NewRobot, Failure> {
    let folder = arguments.out.canonicalize().map_err(|error| unwritable(&arguments.out, &error))?;
    let draft = robot_file(description, to, &folder);
    let file = arguments.out.join(FILE);
    target(arguments, &file).write(&draft.text, &files_of(description), |written| {
        let check = checked(written, description, arguments)?;
        Ok(report(written, description, &draft, check))
    })
}

/// A robot file names a URDF that is a file.
fn is_urdf(path: &Path) -> Result<(), Diagnostic> {
    let refused = |why: &str, help: &str| {
        Err(Diagnostic::error(codes::new::URDF, format!("{} {why}", path.display())).with_help(help))
    };
    if is_standard_input(path) {
        return refused(
            "is standard input, but a robot file must name its URDF by a path",
            "give the URDF as a file",
        );
    }
    if path.is_dir() {
        return refused("is a folder", "give the URDF or MJCF in it");
    }
    let is_toml = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"));
    if is_toml {
        return refused("is a robot file already", "give a .urdf file, or edit the robot file");
    }
    Ok(())
}

/// The check of the written file, which must find what the URDF alone finds.
fn checked(written: &Path, before: &RobotDescription, arguments: &Arguments) -> Result<RobotCheck, Failure> {
    let access = allowing_inputs(arguments.arm.robot.access()?, before);
    let description = load_robot_with(written, &access)?;
    for each in [Capability::Clearance, Capability::Physics] {
        // The new file may be in another project than the URDF, whose meshes are then not opened behind a fence, and the
        // robot would lose a use.
        if before.check_capability(each).is_ok()
            && let Err(mut lost) = description.check_capability(each)
        {
            let message = format!(
                "a robot.toml in {} would belong to another project, and files that the URDF names could not be opened",
                arguments.out.display()
            );
            lost.extend([Diagnostic::error(codes::new::PROJECT, message)
                .with_help("choose --out in a folder that contains both the URDF and its meshes")]);
            return Err(lost.into());
        }
    }
    congruent::check(&description, &CheckOptions::default())
        .map_err(|error| Diagnostic::error(congruent::codes::check::ROBOT, error.to_string()).into())
}

fn report(
    written: &Path,
    description: &RobotDescription,
    draft: &RobotFileDraft,
    check: RobotCheck,
) -> NewRobot {
    NewRobot {
        file: written.display().to_string(),
        urdf: description.urdf_path.display().to_string(),
        robot: description.name.clone(),
        chain: description.reported_chain(),
        has_table: draft.no_table.is_none(),
        no_table: draft.no_table.as_ref().map(Finding::from),
        tolerance: draft.tolerance,
        verdict: check.geometry.verdict,
        worst: check.geometry.worst,
        warnings: description.warnings.iter().map(Finding::from).collect(),
    }
}
