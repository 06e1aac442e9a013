//! `congruent sensitivity`: displacement of the tool by small errors of the model.

use congruent::{
    analysis::sensitivity::{plot, sensitivity},
    input::{Diagnostic, units::LARGEST},
    kinematics::Sampling,
    text::sensitivity_text,
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

/// Displacement of the tool by an error of 1 degree or 1 mm in each joint's zero and each DH parameter.
///
/// Worst and mean over the joint range, with the configuration of the worst.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: SetArmArguments,
    /// Number of random configurations.
    #[arg(long, default_value_t = 2000, value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    samples: u32,
    /// Seed of the random configurations.
    #[arg(long, default_value_t = 0, value_parser = seed)]
    seed: u64,
    /// Also for arms like this one with all lengths multiplied, for example 1,1.5.
    #[arg(long, value_delimiter = ',', default_values_t = [1.0], value_parser = factor)]
    length_factors: Vec<f64>,
    #[command(flatten)]
    plot: PlotArgument,
}

fn factor(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|error: std::num::ParseFloatError| error.to_string())?;
    if (1.0 / LARGEST..=LARGEST).contains(&value) {
        Ok(value)
    } else {
        Err(format!("must be from {:e} to {LARGEST:e}", 1.0 / LARGEST))
    }
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let description = arguments.arm.load(printer)?;
    let inputs = files_of(&description);
    arguments.plot.is_none_of(&inputs)?;
    let sampling = Sampling { samples: arguments.samples as usize, seed: arguments.seed };
    let compute = || sensitivity(&description, &arguments.length_factors, sampling);
    let report = waiting(printer, "computing sensitivities", compute)
        .map_err(|error| Diagnostic::error(codes::sensitivity::ROBOT, error.to_string()))?;
    printer.result(&report, |report| {
        if printer.is_quiet() {
            report.largest_in_words()
        } else {
            sensitivity_text(report, &description.robot, &text_options())
        }
    })?;
    arguments.plot.write(|| plot(&report), &inputs)?;
    Ok(0)
}
