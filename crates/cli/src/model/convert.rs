//! `congruent convert`: one model of a robot written as another.

use congruent::{
    analysis::conversion::{Conversion, ConversionSource, ConversionTarget, DEFAULT_ACCURACY, RoundedAxes},
    input::Diagnostic,
};

use crate::{
    failure::Failure,
    input::{ArmArguments, named},
    model::written_model::answer,
    output::file::OutputArgument,
    terminal::print::Printer,
};

/// Converts a robot's model between DH tables, screws and URDF, proved by comparing back.
///
/// Converts the declared table, or the chain of the URDF if no table is declared.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: ArmArguments,
    /// The model that the robot is converted to.
    #[arg(long, value_parser = named::<ConversionTarget>())]
    to: ConversionTarget,
    /// Which model is converted.
    #[arg(long, value_parser = named::<ConversionSource>())]
    from: Option<ConversionSource>,
    #[command(flatten)]
    accuracy: AccuracyArguments,
    #[command(flatten)]
    output: OutputArgument,
}

/// How exact a conversion must be.
#[derive(Debug, Clone, Copy, clap::Args)]
pub(crate) struct AccuracyArguments {
    /// Largest error of the result, rad and m; a coarser one takes nearly parallel axes as parallel.
    #[arg(long, default_value_t = DEFAULT_ACCURACY, value_parser = accuracy)]
    accuracy: f64,
    /// Seed of the random configurations of the proof.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Keep axes as written that are parallel or intersect except for rounding (a quarter turn of 1.5708).
    #[arg(long)]
    exact: bool,
}

impl AccuracyArguments {
    pub(crate) fn conversion(self, from: Option<ConversionSource>, to: ConversionTarget) -> Conversion {
        let rounded_axes = if self.exact { RoundedAxes::Kept } else { RoundedAxes::Corrected };
        Conversion { from, to, accuracy: self.accuracy, seed: self.seed, rounded_axes }
    }
}

fn accuracy(text: &str) -> Result<f64, String> {
    const FINEST: f64 = 1e-15;
    const COARSEST: f64 = 1e-2;
    let value: f64 = text.parse().map_err(|error| format!("{error}"))?;
    let is_sound = (FINEST..=COARSEST).contains(&value);
    if is_sound { Ok(value) } else { Err(format!("must be from {FINEST:e} to {COARSEST:e}")) }
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let description = arguments.arm.load(printer)?;
    let dropped = description
        .warnings
        .iter()
        .find(|warning| warning.code == congruent::description::codes::chain::TABLE_DROPPED);
    if let (Some(dropped), Some(ConversionSource::Dh)) = (dropped, arguments.from) {
        return Err(Diagnostic::error(
            congruent::analysis::codes::convert::NO_DH,
            format!("--from dh: {}", dropped.message),
        )
        .with_help("omit --base and --tip, or convert the chosen chain with --from urdf")
        .into());
    }
    let conversion = arguments.accuracy.conversion(arguments.from, arguments.to);
    answer(&description, &conversion, &arguments.output, printer)
}
