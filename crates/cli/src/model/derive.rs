//! `congruent derive`: a Denavit-Hartenberg table from a URDF, or its base inertial parameters.

use clap::ValueEnum;
use congruent::{
    analysis::{
        base_parameters::base_parameters as derived,
        conversion::{ConversionSource, ConversionTarget},
    },
    description::{Followers, RobotDescription},
    input::Diagnostic,
    text::base_parameters_text,
};

use crate::{
    codes,
    failure::Failure,
    input::ArmArguments,
    model::{convert::AccuracyArguments, written_model::answer},
    output::file::OutputArgument,
    terminal::print::Printer,
};

/// A Denavit-Hartenberg table from the axes of a URDF, proved by comparing back.
///
/// Prints the section `[dh]` of a robot file, with the free choices as comments, or writes a whole robot file with
/// --out. With --base-parameters prints the base parameters instead, which are the sums of inertial parameters that
/// are identifiable from joint torques. Axes that are parallel or intersect except for rounding in the URDF are taken
/// as exactly so, and reported.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: ArmArguments,
    /// Which equation the rows stand for; the same values are another robot in the other one.
    #[arg(long, value_enum, required_unless_present = "base_parameters")]
    convention: Option<ConventionArgument>,
    /// Print the base parameters instead: the sums of masses, first moments and inertias that are identifiable from
    /// joint torques, with the parameters grouped in each, and the parameters that change no torque.
    #[arg(long, conflicts_with_all = ["convention", "exact", "out"])]
    base_parameters: bool,
    /// Count each joint that follows another by <mimic> as if it were driven, with a torque of its own.
    #[arg(long, requires = "base_parameters")]
    free_followers: bool,
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
    let followers = if arguments.free_followers { Followers::Free } else { Followers::Folded };
    let to = match arguments.convention {
        None => return base_parameters(&description, followers, printer),
        Some(ConventionArgument::Standard) => ConversionTarget::Standard,
        Some(ConventionArgument::Modified) => ConversionTarget::Modified,
    };
    let conversion = arguments.accuracy.conversion(Some(ConversionSource::Urdf), to);
    answer(&description, &conversion, &arguments.output, printer)
}

/// Seed of the motions at which torques are computed; the result does not depend on it.
const SEED: u64 = 0;

fn base_parameters(
    description: &RobotDescription,
    followers: Followers,
    printer: &Printer,
) -> Result<u8, Failure> {
    if description.robot.dof() == 0 {
        let message = format!(
            "{}: all joints are fixed, so there are no base parameters",
            description.urdf_path.display()
        );
        return Err(Diagnostic::error(codes::derive::NO_JOINT, message).into());
    }
    let report = derived(description, followers, SEED)
        .map_err(|error| Diagnostic::error(codes::derive::BASE_PARAMETERS, error.to_string()))?;
    printer.result(&report, base_parameters_text)?;
    Ok(0)
}
