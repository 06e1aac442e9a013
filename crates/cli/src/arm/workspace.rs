//! `congruent workspace`: the reachable positions of the tool.

use congruent::{
    analysis::workspace::{plot, workspace},
    input::Diagnostic,
    kinematics::Sampling,
    text::workspace_text,
};

use crate::{
    codes,
    failure::Failure,
    input::{SetArmArguments, files_of, seed},
    output::plot::PlotArgument,
    terminal::{
        print::{Printer, text_options},
        progress::waiting,
    },
};

/// The positions of the tool within the joint limits: reach, bounding box, volume or area.
///
/// From random configurations; the extremes are refined by local search. The size is the share of random
/// points of the bounding box that inverse kinematics reaches, with an interval of three standard errors.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: SetArmArguments,
    /// Number of random configurations; 20,000 or one in 20 points are tested for the size.
    #[arg(long, default_value_t = 400_000, value_parser = clap::value_parser!(u32).range(1..=50_000_000))]
    samples: u32,
    /// Seed of the random configurations.
    #[arg(long, default_value_t = 0, value_parser = seed)]
    seed: u64,
    #[command(flatten)]
    plot: PlotArgument,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let description = arguments.arm.load(printer)?;
    let inputs = files_of(&description);
    arguments.plot.is_none_of(&inputs)?;
    let sampling = Sampling { samples: arguments.samples as usize, seed: arguments.seed };
    let (report, found) = waiting(printer, "computing the workspace", || workspace(&description, sampling))
        .map_err(|error| Diagnostic::error(codes::workspace::ROBOT, error.to_string()))?;
    printer.result(&report, |report| workspace_text(report, &description.robot, &text_options()))?;
    arguments.plot.write(|| plot(&report, &found), &inputs)?;
    Ok(0)
}
