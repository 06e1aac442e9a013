//! `congruent acm`: pairs of links to exclude from collision checking.

use std::{fmt::Write, path::PathBuf};

use congruent::{
    input::{
        Capability, Diagnostic,
        display::{counted, length},
    },
    kinematics::Sampling,
    proximity::{DisableReason, DisabledPairs, srdf_text, suggest_disabled},
};

use crate::{
    failure::{Failure, NOTHING},
    input::{RobotArgument, files_of},
    output::file::{NewFile, folder_of},
    terminal::{layout::paragraph, print::Printer, progress::waiting},
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
        .map_err(|error| Diagnostic::error("acm::shape", error.to_string()))?;
    let srdf = srdf_text(&pairs);
    if pairs.pairs == 0 {
        printer.result(&pairs, summary)?;
        return Ok(NOTHING);
    }
    match &file {
        Some(file) => {
            file.write(&srdf, &inputs, |_| Ok(()))?;
            printer
                .result(&pairs, |pairs| format!("{}written to {}\n", summary(pairs), file.path.display()))?;
        }
        None => printer.verbatim(&pairs, |pairs| {
            // Two hyphens end a comment in XML.
            let remarks = format!("<!--\n{}-->\n", summary(pairs).replace("--", "- -"));
            srdf.clone() + &remarks
        })?,
    }
    Ok(0)
}

/// How many pairs have which reason, and what to examine before the SRDF is used.
fn summary(pairs: &DisabledPairs) -> String {
    let mut text = String::new();
    let (of_links, links) = (counted(pairs.pairs, "pair"), counted(pairs.links, "link"));
    let _ = writeln!(text, "{}: {of_links} of {links} with a shape", pairs.robot);
    if pairs.pairs == 0 {
        return text + "  no pair to examine: no SRDF is written\n";
    }
    let counts = [
        (DisableReason::Adjacent, "connected by a joint".to_owned()),
        (DisableReason::Default, "touch in the default position".to_owned()),
        (DisableReason::Always, format!("touch in 95 % of {} samples, seed {}", pairs.samples, pairs.seed)),
        (DisableReason::Never, "no contact in any sample, which is no proof".to_owned()),
    ];
    for (reason, words) in counts {
        let _ = writeln!(text, "  {:4} {reason:?}: {words}", pairs.count(reason));
    }
    let _ = writeln!(
        text,
        "  {:4} touch in some configurations: keep them in collision checking",
        pairs.pairs - pairs.suggested.len()
    );
    if let Some(nearest) = pairs.nearest_never()
        && let Some(least_m) = nearest.least_m
    {
        let [a, b] = &nearest.pair;
        text += &paragraph(
            &format!("nearest pair of Never: {a} and {b}, smallest distance {}", length(least_m)),
            2,
            4,
        );
    }
    if let Some(declared) = &pairs.declared {
        let line = format!(
            "pairs that the robot's SRDF disables: {}; also suggested: {}; without a shape: {}",
            declared.pairs, declared.suggested, declared.without_shape
        );
        text += &paragraph(&line, 2, 4);
        for [a, b] in &declared.hidden {
            text += &paragraph(
                &format!("it disables {a} and {b}, which touch in some configurations and not in others"),
                2,
                4,
            );
        }
    }
    text
}
