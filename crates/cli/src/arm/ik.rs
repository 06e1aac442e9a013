//! `congruent ik`: joint positions that bring the tool to given poses.

use std::path::PathBuf;

use congruent::{
    analysis::inverse::{
        IkMethod, IkOptions, InverseTargets, LiveTargets, TargetPart, inverse, read_targets,
        read_targets_from,
    },
    description::{LiveInput, RobotDescription},
    input::{Diagnostic, Findings, Severity, is_standard_input, units::Unit},
    text::inverse_text,
};

use crate::{
    codes,
    failure::{FAILED, Failure, NOTHING},
    input::{ArmArguments, named},
    terminal::print::{Printer, text_options},
};

/// Joint positions that bring the tip, or the TCP if one is declared, to given poses.
///
/// Targets count from 1, in the order of the file. Exit code 1 if one is not reached, with the residual
/// and the joints at a limit; 4 if the file has none.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: ArmArguments,
    /// A file with a JSON array of `{"translation_m": [x, y, z], "quaternion_wxyz": [w, x, y, z], "start": {"joint":
    /// value}}`; without a quaternion any orientation will do. Poses are in link `base`. - is standard input, where one target per
    /// line (JSON Lines) is answered at once, with --format json by a document in one line.
    #[arg(long, value_name = "FILE")]
    targets: PathBuf,
    /// Method by which steps are found.
    #[arg(long, default_value = "lm", value_parser = named::<IkMethod>())]
    method: IkMethod,
    /// Reach only the positions, even if a target has an orientation.
    #[arg(long)]
    position_only: bool,
    /// Seed of the restarts.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Largest distance in m and largest angle in rad that count as reached.
    #[arg(long, default_value_t = IkOptions::default().tolerance_m, value_parser = tolerance)]
    tolerance: f64,
    /// Steps that are tried for each target, restarts included.
    #[arg(long, default_value_t = IkOptions::default().max_iterations)]
    iterations: usize,
}

fn tolerance(text: &str) -> Result<f64, String> {
    let value = text.parse().map_err(|error: std::num::ParseFloatError| error.to_string())?;
    if value > 0.0 { Ok(value) } else { Err("it must be above 0".to_owned()) }
}

/// Refuses a tolerance within which every pose counts as reached, and warns of a wide one.
fn examine_tolerance(
    tolerance: f64,
    description: &RobotDescription,
    printer: &Printer,
) -> Result<(), Failure> {
    let scale = description.tolerance_scale();
    let found = [Unit::Length, Unit::Angle]
        .into_iter()
        .filter_map(|unit| scale.examine(unit, "--tolerance", tolerance));
    let (wrong, wide): (Vec<_>, Vec<_>) = found.partition(|found| found.severity == Severity::Error);
    printer.warnings(None, &wide);
    if wrong.is_empty() { Ok(()) } else { Err(Findings::from(wrong).into()) }
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let description = arguments.arm.load(printer)?;
    examine_tolerance(arguments.tolerance, &description, printer)?;
    if !is_standard_input(&arguments.targets) {
        let targets = read_targets(&arguments.targets, &description.robot)?;
        return answer(arguments, &description, targets, 1, printer);
    }
    let mut lines = match LiveTargets::open(&arguments.targets)? {
        LiveInput::Lines(lines) => lines,
        LiveInput::Whole(lines) => {
            let targets = read_targets_from(*lines, &description.robot)?;
            return answer(arguments, &description, targets, 1, printer);
        }
    };
    let mut code = NOTHING;
    while let Some((number, targets)) = lines.next_target(&description.robot)? {
        let answered = answer(arguments, &description, targets, number, printer)?;
        // Nothing was answered before the first; a target that is not reached decides.
        code = if code == NOTHING { answered } else { code.max(answered) };
    }
    Ok(code)
}

/// Prints the answer to targets, of which the first has this number; the exit code.
fn answer(
    arguments: &Arguments,
    description: &RobotDescription,
    mut targets: InverseTargets,
    first: usize,
    printer: &Printer,
) -> Result<u8, Failure> {
    printer.warnings(None, &targets.warnings);
    if arguments.position_only {
        for target in &mut targets.targets {
            target.target.part = TargetPart::Position;
        }
    }
    let options = IkOptions {
        method: arguments.method,
        tolerance_m: arguments.tolerance,
        tolerance_rad: arguments.tolerance,
        max_iterations: arguments.iterations,
        seed: arguments.seed,
    };
    let report = inverse(description, &targets, &options)
        .map_err(|error| Diagnostic::error(codes::ik::ROBOT, error.to_string()))?;
    printer.result(&report, |report| {
        inverse_text(report, &description.robot, arguments.tolerance, first, &text_options())
    })?;
    Ok(match &report.results[..] {
        [] => NOTHING,
        results if results.iter().all(|result| result.converged) => 0,
        _ => FAILED,
    })
}
