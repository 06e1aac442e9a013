//! `congruent ik`: joint positions that bring the tool to given poses.

#![expect(clippy::doc_markdown, reason = "the comments are printed as help, where backticks are noise")]

use std::{
    ffi::OsStr,
    path::{Path, PathBuf},
};

use congruent::{
    analysis::inverse::{
        IkMethod, IkOptions, InverseTarget, InverseTargets, LiveTargets, TargetPart, inverse, read_targets,
        read_targets_from,
    },
    configurations::LiveInput,
    description::{RobotDescription, Tolerance},
    input::{Diagnostic, Findings, is_standard_input},
    text::inverse_text,
};

use crate::{
    codes,
    failure::{FAILED, Failure, NOTHING},
    input::{SetArmArguments, named, seed},
    quantity::{three_angles, three_lengths},
    terminal::print::{Printer, text_options},
    tolerance::ToleranceArgument,
};

/// Joint positions that bring the tip, or the TCP if one is declared, to given poses.
///
/// Targets count from 1, in the order of the file. Exit code 1 if one is not reached, with the residual
/// and the joints at a limit; 4 if the file has none.
#[derive(Debug, clap::Args)]
#[command(
    group = clap::ArgGroup::new("target").args(["xyz", "targets"]).required(true),
    override_usage = "congruent ik <ROBOT> --xyz <X,Y,Z> [--rpy <ROLL,PITCH,YAW>] [OPTIONS]\n       \
                      congruent ik <ROBOT> --targets <FILE> [OPTIONS]",
)]
pub(crate) struct Arguments {
    /// Position of the tool in link `base`: `0.4,0.1,0.3` in m, or `400mm,100mm,300mm`.
    #[arg(long, value_name = "X,Y,Z", value_parser = three_lengths, allow_hyphen_values = true)]
    xyz: Option<[f64; 3]>,
    /// Its orientation as roll, pitch and yaw about the fixed axes x, y, z of the base, each with its unit: `180deg,0,90deg`.
    /// Without it any orientation will do.
    #[arg(long, value_name = "ROLL,PITCH,YAW", requires = "xyz", value_parser = three_angles, allow_hyphen_values = true)]
    rpy: Option<[f64; 3]>,
    /// A table (.csv) with columns x_mm, y_mm, z_mm (or _m), perhaps roll_deg, pitch_deg, yaw_deg (or qw, qx, qy, qz) and joints
    /// where the search starts; or a file with a JSON array of `{"translation_m": [x, y, z], "quaternion_wxyz": [w, x, y, z], "start": {"joint":
    /// value}}`; without a quaternion any orientation will do. Poses are in link `base`. - is standard input, where one target per
    /// line (JSON Lines) is answered at once, with --format json by a document in one line.
    #[arg(long, value_name = "FILE")]
    targets: Option<PathBuf>,
    /// Method by which steps are found.
    #[arg(long, default_value = "lm", value_parser = named::<IkMethod>())]
    method: IkMethod,
    /// Reach only the positions, even if a target has an orientation.
    #[arg(long)]
    position_only: bool,
    /// Seed of the restarts.
    #[arg(long, default_value_t = 0, value_parser = seed)]
    seed: u64,
    /// Largest distance, largest angle, or both that count as reached: 1mm, or 1mm,0.1deg. By default 1nm,1nrad.
    #[arg(long, value_name = "LENGTH,ANGLE", allow_hyphen_values = true)]
    tolerance: Option<ToleranceArgument>,
    /// Steps that are tried for each target, restarts included.
    #[arg(long, default_value_t = IkOptions::default().max_iterations)]
    iterations: usize,
    // Last: the help lists the options in this order, and most calls need no chain.
    #[command(flatten)]
    arm: SetArmArguments,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let description = arguments.arm.load(printer)?;
    let search = arguments.search(&description, printer)?;
    let answer = |targets, first| search.answer(&description, targets, first, printer);
    let Some(file) = &arguments.targets else {
        let target = arguments.xyz.map(|xyz_m| InverseTarget::new(xyz_m, arguments.rpy));
        return answer(InverseTargets { targets: target.into_iter().collect(), warnings: Vec::new() }, 1);
    };
    refuse_robot(file)?;
    if !is_standard_input(file) {
        return answer(read_targets(file, &description.robot)?, 1);
    }
    let mut lines = match LiveTargets::open(file)? {
        LiveInput::Lines(lines) => lines,
        LiveInput::Whole(lines) => {
            return answer(read_targets_from(*lines, &description.robot)?, 1);
        }
    };
    let mut code = NOTHING;
    while let Some((number, targets)) = lines.next_target(&description.robot)? {
        let answered = answer(targets, number)?;
        // Nothing was answered before the first; a target that is not reached decides.
        code = if code == NOTHING { answered } else { code.max(answered) };
    }
    Ok(code)
}

/// Refuses a robot in the place of a table: as JSON it would be malformed, which it is not meant to be.
fn refuse_robot(file: &Path) -> Result<(), Diagnostic> {
    let is_robot = |ending: &OsStr| ["urdf", "xml", "xacro", "toml"].iter().any(|robot| ending == *robot);
    if !file.extension().is_some_and(is_robot) {
        return Ok(());
    }
    let message = format!("--targets {} is a robot, not a table of targets", file.display());
    Err(Diagnostic::error(codes::ik::ROBOT, message)
        .with_help("give a table (.csv) or a JSON file, or one target with --xyz and --rpy"))
}

impl Arguments {
    /// What is searched; refuses a tolerance within which every pose counts as reached, and warns of a wide one.
    fn search(&self, description: &RobotDescription, printer: &Printer) -> Result<IkSearch, Failure> {
        let usual = IkOptions::default();
        let usual_tolerance =
            Tolerance { position_m: usual.tolerance_m, orientation_rad: usual.tolerance_rad };
        let given = self.tolerance.unwrap_or_default();
        let (wrong, wide) = given.examine(description.tolerance_scale());
        printer.warnings(None, &wide);
        if !wrong.is_empty() {
            return Err(Findings::from(wrong).into());
        }
        let Tolerance { position_m: tolerance_m, orientation_rad: tolerance_rad } =
            given.replace(usual_tolerance);
        let options = IkOptions {
            method: self.method,
            tolerance_m,
            tolerance_rad,
            max_iterations: self.iterations,
            seed: self.seed,
        };
        Ok(IkSearch { options, is_position_only: self.position_only })
    }
}

/// How targets are reached.
struct IkSearch {
    options: IkOptions,
    is_position_only: bool,
}

impl IkSearch {
    /// Prints the answer to targets, of which the first has this number; the exit code.
    fn answer(
        &self,
        description: &RobotDescription,
        mut targets: InverseTargets,
        first: usize,
        printer: &Printer,
    ) -> Result<u8, Failure> {
        printer.warnings(None, &targets.warnings);
        if self.is_position_only {
            for target in &mut targets.targets {
                target.target.part = TargetPart::Position;
            }
        }
        let report = inverse(description, &targets, &self.options)
            .map_err(|error| Diagnostic::error(codes::ik::ROBOT, error.to_string()))?;
        printer.result(&report, |report| {
            inverse_text(report, &description.robot, &self.options, first, &text_options())
        })?;
        Ok(match &report.results[..] {
            [] => NOTHING,
            results if results.iter().all(|result| result.converged) => 0,
            _ => FAILED,
        })
    }
}
