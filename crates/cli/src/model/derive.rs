//! `congruent derive`: a Denavit-Hartenberg table from a URDF.

use clap::ValueEnum;
use congruent::analysis::conversion::{Conversion, ConversionSource, ConversionTarget, convert};

use crate::{
    failure::Failure,
    input::{ChainArguments, RobotArgument},
    model::convert::{AccuracyArguments, text},
    print::Printer,
};

/// A Denavit-Hartenberg table from the axes of a URDF, proved by comparing back.
///
/// Prints the section `[dh]` of a robot file, with the free choices beside it.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    /// Which equation the rows stand for; the same values are another robot in the other one.
    #[arg(long, value_enum)]
    convention: ConventionArgument,
    #[command(flatten)]
    chain: ChainArguments,
    #[command(flatten)]
    accuracy: AccuracyArguments,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum ConventionArgument {
    /// Rz(theta) Tz(d) Tx(a) Rx(alpha).
    Standard,
    /// Rx(alpha) Tx(a) Rz(theta) Tz(d) (Craig).
    Modified,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let description = arguments.chain.choose(arguments.robot.load(printer)?)?;
    let to = match arguments.convention {
        ConventionArgument::Standard => ConversionTarget::Standard,
        ConventionArgument::Modified => ConversionTarget::Modified,
    };
    let AccuracyArguments { accuracy, seed } = arguments.accuracy;
    let report =
        convert(&description, &Conversion { from: Some(ConversionSource::Urdf), to, accuracy, seed })?;
    printer.result(&report, text)?;
    Ok(0)
}
