//! `congruent derive`: a Denavit-Hartenberg table from a URDF.

use clap::ValueEnum;
use congruent::analysis::conversion::{ConversionSource, ConversionTarget};

use crate::{
    failure::Failure,
    input::ArmArguments,
    model::{convert::AccuracyArguments, written_model::answer},
    output_file::OutputArgument,
    print::Printer,
};

/// A Denavit-Hartenberg table from the axes of a URDF, proved by comparing back.
///
/// Prints the section `[dh]` of a robot file, with the free choices beside it, or writes a whole robot file with
/// --output. Axes that are parallel or meet but for rounded values of the URDF are taken as such, and told.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: ArmArguments,
    /// Which equation the rows stand for; the same values are another robot in the other one.
    #[arg(long, value_enum)]
    convention: ConventionArgument,
    #[command(flatten)]
    accuracy: AccuracyArguments,
    #[command(flatten)]
    output: OutputArgument,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum ConventionArgument {
    /// Rz(theta) Tz(d) Tx(a) Rx(alpha).
    Standard,
    /// Rx(alpha) Tx(a) Rz(theta) Tz(d) (Craig).
    Modified,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let description = arguments.arm.load_urdf(printer)?;
    let to = match arguments.convention {
        ConventionArgument::Standard => ConversionTarget::Standard,
        ConventionArgument::Modified => ConversionTarget::Modified,
    };
    let conversion = arguments.accuracy.conversion(Some(ConversionSource::Urdf), to);
    answer(&description, &conversion, &arguments.output, printer)
}
