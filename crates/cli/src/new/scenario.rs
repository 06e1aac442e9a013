//! `congruent new scenario`: a scenario for a robot, which has been run.

use std::path::PathBuf;

use congruent::{
    description::RobotDescription,
    input::{Capability, Diagnostic, Finding, is_standard_input},
    monitors::verdict::{CheckResult, Status},
    results::report::lines,
    starter::{NewScenario, ScenarioDraft, codes, scenario, try_scenario},
    text::new_scenario_text,
    twin::{Outcome, RunSetup},
};

use crate::{
    failure::Failure,
    input::{RobotArgument, RobotArguments, allowing_inputs, files_of, needs_to_be_allowed},
    output::file::{NewFile, folder_of},
    terminal::{print::Printer, progress::waiting},
};

/// A commented scenario for a robot, which passes.
///
/// The joints of the chain move a little and come back, within their limits and without contact between links; the
/// controller is computed torque, or playback without forces if links that move have no mass. Model and
/// twin, limits, tracking and distances are checked. The scenario is run before it is written. For a robot that
/// cannot be simulated, or for which no scenario passes, nothing is written, and the reason is printed.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    /// The scenario file, whose name without .toml is that of the scenario.
    #[arg(long, value_name = "FILE.toml")]
    to: PathBuf,
    /// Replace the file of --to if it exists.
    #[arg(long)]
    force: bool,
}

pub(super) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let to = &arguments.to;
    let refused =
        |message: String, help: &str| Diagnostic::error(codes::new::SCENARIO, message).with_help(help);
    if is_standard_input(&arguments.robot.robot) {
        let message =
            "the robot came from standard input, but a scenario must name its robot by a path".to_owned();
        return Err(refused(message, "give the robot as a file").into());
    }
    if to.extension().is_none_or(|extension| !extension.eq_ignore_ascii_case("toml")) {
        let message = format!("--to {}: the name of a scenario file must end in .toml", to.display());
        return Err(refused(message, "for example --to scenarios/first.toml").into());
    }
    let description = arguments.robot.load_for(Capability::Physics, printer)?;
    let inputs = files_of(&description);
    let file = NewFile { option: "--to", path: to, force: arguments.force };
    let folder = folder_of(to)?;
    file.may_be_written(&inputs)?;
    let name = to.file_name().unwrap_or_default();
    let find = || scenario(&description, &folder.join(name));
    let draft = waiting(printer, "trying motions", find)?;
    let (setup, outcome) = file.write(&draft.text, &inputs, |written| {
        let setup =
            RunSetup::load_with(written, &[], &allowing_inputs(arguments.robot.access()?, &description))?;
        let outcome = waiting(printer, "running the new scenario", || try_scenario(&setup))?;
        passed(&outcome)?;
        Ok((setup, outcome))
    })?;
    let mut report = report(arguments, &description, draft, &setup, outcome);
    if let Some(warning) = needs_to_be_allowed(&arguments.robot.access()?, to, &description.path) {
        printer.warnings(None, std::slice::from_ref(&warning));
        report.warnings.push(Finding::from(&warning));
    }
    printer.result(&report, new_scenario_text)?;
    Ok(0)
}

/// The written file must do what its draft did.
fn passed(outcome: &Outcome) -> Result<(), Failure> {
    let failed = |check: &&CheckResult| check.status != Status::Pass;
    match outcome.checks.iter().find(failed) {
        None => Ok(()),
        Some(check) => {
            let why = lines(check).join("; ");
            let message =
                format!("the scenario does not pass as it is written: check {}: {why}", check.check);
            Err(Failure::Machine(message))
        }
    }
}

fn report(
    arguments: &Arguments,
    description: &RobotDescription,
    draft: ScenarioDraft,
    setup: &RunSetup,
    outcome: Outcome,
) -> NewScenario {
    NewScenario {
        file: arguments.to.display().to_string(),
        robot: description.name.clone(),
        chain: description.reported_chain(),
        joints: draft.joints,
        controller: setup.scenario.controller.kind.name().to_owned(),
        duration_s: setup.clock.duration_s(),
        remarks: draft.remarks,
        checks: outcome.checks,
        warnings: description.warnings.iter().map(Finding::from).collect(),
    }
}
