//! `congruent acm`: pairs of links to exclude from collision checking.

use std::path::PathBuf;

use congruent::{
    input::{Capability, Diagnostic},
    kinematics::Sampling,
    proximity::{srdf_text, suggest_disabled},
    text::disabled_pairs_text,
};

use crate::{
    codes,
    failure::{Failure, NOTHING},
    input::{RobotArgument, files_of},
    output::file::{NewFile, folder_of},
    terminal::{print::Printer, progress::waiting},
};

/// Suggests link pairs to exclude from collision checking (allowed collision matrix).
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    what: AcmCommand,
}

#[derive(Debug, clap::Subcommand)]
enum AcmCommand {
    Suggest(SuggestArguments),
}

/// Suggests an SRDF of link pairs that never or always touch, with the reasons of MoveIt's setup assistant.
///
/// Adjacent: connected by a joint. Default: touching with all joints at 0, or at the middle of a range without 0.
/// Always: touching in 95 % of the sampled configurations. Never: touching in none of them, which is no proof. Meshes
/// are taken as their convex hulls. Nothing is applied: the SRDF is printed, or written with --out; the key `srdf` of
/// a robot file names it. Pairs that the robot's own SRDF disables are compared with these, and not copied.
#[derive(Debug, clap::Args)]
struct SuggestArguments {
    #[command(flatten)]
    robot: RobotArgument,
    /// Number of random configurations.
    #[arg(long, default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(100..=10_000_000))]
    samples: u32,
    /// Seed of the random configurations.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Write the SRDF to this file instead of printing it.
    #[arg(long, value_name = "FILE.srdf")]
    out: Option<PathBuf>,
    /// Replace the file of --out if it exists.
    #[arg(long, requires = "out")]
    force: bool,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let AcmCommand::Suggest(arguments) = &arguments.what;
    let description = arguments.robot.load_for(Capability::Clearance, printer)?;
    let inputs = files_of(&description);
    let file = arguments.out.as_deref().map(|path| NewFile { option: "--out", path, force: arguments.force });
    if let Some(file) = &file {
        folder_of(file.path)?;
        file.may_be_written(&inputs)?;
    }
    let sampling = Sampling { samples: arguments.samples as usize, seed: arguments.seed };
    let pairs = waiting(printer, "measuring pairs", || suggest_disabled(&description, sampling))
        .map_err(|error| Diagnostic::error(codes::acm::SHAPE, error.to_string()))?;
    let srdf = srdf_text(&pairs);
    if pairs.pairs == 0 {
        printer.result(&pairs, disabled_pairs_text)?;
        return Ok(NOTHING);
    }
    match &file {
        Some(file) => {
            file.write(&srdf, &inputs, |_| Ok(()))?;
            printer.result(&pairs, |pairs| {
                format!("{}written to {}\n", disabled_pairs_text(pairs), file.path.display())
            })?;
        }
        None => printer.verbatim(&pairs, |pairs| {
            // Two hyphens end a comment in XML.
            let remarks = format!("<!--\n{}-->\n", disabled_pairs_text(pairs).replace("--", "- -"));
            srdf.clone() + &remarks
        })?,
    }
    Ok(0)
}
