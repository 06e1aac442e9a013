//! `congruent plan`: a motion that shows the parameters of a robot.

use std::path::PathBuf;

use congruent::{
    identify::{PLAN_FILES, PlanRequest, plan_excitation, plan_text},
    input::Capability,
    text::plan_report_text,
    twin::RunSetup,
};

use crate::{
    failure::Failure,
    input::{ArmArguments, files_of, seed},
    invocation,
    model::identify::FreeArgument,
    output::file::NewFile,
    quantity::{Dimension, QuantityArgument},
    terminal::{print::Printer, progress::waiting},
};

/// A motion for `identify`: within the limits of the robot, away from obstacles, and with the most information of all that were tried.
///
/// It is a sum of sines of all driven joints that begins and ends at rest. What it will show is printed: the standard error of each
/// parameter. DIR gets the positions over time (identification.csv) and a scenario that simulates them
/// (identification.toml), with limits and distances checked. Nothing is sent to a robot.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: ArmArguments,
    /// Folder for the two files.
    #[arg(long, value_name = "DIR", default_value = "identification")]
    out: PathBuf,
    /// Replace the files in it.
    #[arg(long)]
    force: bool,
    /// What the motion shall show.
    #[arg(long, value_delimiter = ',', value_enum, default_values = ["friction", "armature"])]
    free: Vec<FreeArgument>,
    /// The link that carries the payload; by default the TCP.
    #[arg(long, value_name = "LINK")]
    payload_at: Option<String>,
    /// How long the motion takes, s.
    #[arg(long, value_name = "S", default_value = "20", value_parser = duration_s)]
    duration_s: f64,
    /// Part of the velocity limits that it uses.
    #[arg(long, value_name = "PART", default_value = "0.5", value_parser = part)]
    speed: f64,
    /// Smallest distance of links from each other and from obstacles.
    #[arg(long, value_name = "LENGTH", default_value = "20mm", value_parser = length_m)]
    clearance: f64,
    /// Noise of the efforts for which the standard errors are given, as part of its effort limit.
    #[arg(long, value_name = "PART", default_value = "0.01", value_parser = part)]
    effort_noise: f64,
    /// A scenario whose obstacles it keeps away from, and at whose start it begins.
    #[arg(long, value_name = "FILE")]
    scenario: Option<PathBuf>,
    /// Seed of the motions that are tried.
    #[arg(long, default_value_t = 0, value_parser = seed)]
    seed: u64,
}

fn duration_s(text: &str) -> Result<f64, String> {
    let value = text.trim_end_matches('s').trim().parse().ok().filter(|value| (1.0..=600.0).contains(value));
    value.ok_or_else(|| format!("\"{text}\" is no time from 1 to 600 s"))
}

fn part(text: &str) -> Result<f64, String> {
    let value = text.trim().parse().ok().filter(|value| *value > 0.0 && *value <= 1.0);
    value.ok_or_else(|| format!("\"{text}\" is no part above 0 and up to 1"))
}

fn length_m(text: &str) -> Result<f64, String> {
    let value = QuantityArgument::of(text, Dimension::Length)?;
    if value < 0.0 { Err(format!("\"{text}\" is negative")) } else { Ok(value) }
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let Arguments { out, force, .. } = arguments;
    let description = arguments.arm.load_for(Capability::Physics, printer)?;
    let paths = PLAN_FILES.map(|name| out.join(name));
    let files = paths.each_ref().map(|path| NewFile { option: "--out", path, force: *force });
    let inputs: Vec<PathBuf> = files_of(&description).into_iter().chain(arguments.scenario.clone()).collect();
    for file in &files {
        file.may_be_written(&inputs)?;
    }
    let surroundings = match &arguments.scenario {
        Some(path) => Some(RunSetup::load(path, &[])?),
        None => None,
    };
    let request = PlanRequest {
        free: arguments.free.iter().map(|group| group.of_library()).collect(),
        payload_at: arguments.payload_at.clone(),
        duration_s: arguments.duration_s,
        speed: arguments.speed,
        clearance_m: arguments.clearance,
        effort_noise: arguments.effort_noise,
        seed: arguments.seed,
    };
    let mut planned =
        waiting(printer, "planning", || plan_excitation(&description, surroundings.as_ref(), &request))?;
    std::fs::create_dir_all(out)
        .map_err(|error| Failure::Machine(format!("cannot create {}: {error}", out.display())))?;
    files[0].write(&planned.table, &inputs, |_| Ok(()))?;
    let text = plan_text(&planned.scenario, out, &invocation::command())?;
    files[1].write(&text, &inputs, |_| Ok(()))?;
    planned.report.written = paths.iter().map(|path| path.display().to_string()).collect();
    printer.result(&planned.report, plan_report_text)?;
    Ok(0)
}
