//! `congruent manipulability`: how well the tool moves in each direction.

use congruent::{
    analysis::manipulability::{manipulability, plot},
    text::manipulability_text_parts,
};

use crate::{
    configurations::ConfigurationArguments,
    failure::Failure,
    input::{SetArmArguments, files_of},
    output::plot::PlotArgument,
    quantity::positive_length,
    terminal::print::{Printer, text_options},
};

/// Velocity ellipsoids of the tool, Yoshikawa's measure, condition and distance to singularity.
///
/// Linear and angular parts are separate since their units differ. If some joints turn and others slide, a
/// length counts as one radian of joint motion, so that no measure depends on the unit of length. A plot shows
/// the first configuration.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: SetArmArguments,
    #[command(flatten)]
    configurations: ConfigurationArguments,
    /// The length that counts as one radian, of the tool and of sliding joints; by default the typical distance
    /// of the tool from the turning axes.
    #[arg(long, value_name = "LENGTH", value_parser = positive_length)]
    length: Option<f64>,
    #[command(flatten)]
    plot: PlotArgument,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let mut description = arguments.arm.load(printer)?;
    let configurations = arguments.configurations.read(&mut description, printer)?;
    let inputs = files_of(&description);
    arguments.plot.is_none_of(&inputs)?;
    let report = manipulability(&description, configurations.iter(), arguments.length)?;
    let options = text_options();
    let printed =
        printer.parts(&report, |report| manipulability_text_parts(report, &description.robot, &options));
    report.results.end()?;
    printed?;
    if let Some(q) = configurations.get(0) {
        let first = manipulability(&description, configurations.iter().take(1), arguments.length)?;
        if let Some(result) = first.results.iter().next() {
            arguments.plot.write(|| plot(&description, &q, &result), &inputs)?;
        }
    }
    Ok(0)
}
