//! `congruent clearance --write-srdf`: pairs of links to exclude from collision checking.

use std::path::{Path, PathBuf};

use congruent::{
    description::RobotDescription,
    input::{Diagnostic, is_standard_input},
    kinematics::Sampling,
    proximity::{srdf_text, suggest_disabled},
    text::disabled_pairs_text,
};

use crate::{
    codes,
    failure::{Failure, NOTHING},
    input::{files_of, seed},
    output::file::{NewFile, folder_of},
    terminal::{print::Printer, progress::waiting},
};

/// An SRDF of pairs that need no collision checking.
#[derive(Debug, clap::Args)]
pub(super) struct DisabledPairsArguments {
    /// Write an SRDF of link pairs to exclude from collision checking to this file instead of measuring distances; - prints it.
    ///
    /// The allowed collision matrix (ACM), with the reasons of MoveIt's setup assistant. Adjacent: connected by a joint. Default:
    /// touching with all joints at 0, or at the middle of a range without 0. Always: touching in 95 % of the sampled
    /// configurations. Never: touching in none of them, which is no proof. Meshes are taken as their convex hulls. The key `srdf`
    /// of a robot file names the file. Pairs that the robot's own SRDF disables are compared with these, and not copied.
    #[arg(long, value_name = "FILE.srdf", conflicts_with_all = ["configurations", "at", "penetration", "all_pairs", "pair", "ignore", "limit", "overrides"])]
    write_srdf: Option<PathBuf>,
    /// Number of random configurations of --write-srdf.
    #[arg(long, default_value_t = 10_000, requires = "write_srdf", value_parser = clap::value_parser!(u32).range(100..=10_000_000))]
    samples: u32,
    /// Seed of the random configurations of --write-srdf.
    #[arg(long, default_value_t = 0, requires = "write_srdf", value_parser = seed)]
    seed: u64,
    /// Replace the file of --write-srdf if it exists.
    #[arg(long, requires = "write_srdf")]
    force: bool,
}

impl DisabledPairsArguments {
    /// The file, or `-` for standard output, if an SRDF is wanted.
    pub(super) fn file(&self) -> Option<&Path> {
        self.write_srdf.as_deref()
    }

    /// Writes the SRDF.
    pub(super) fn write(
        &self,
        path: &Path,
        description: &RobotDescription,
        printer: &Printer,
    ) -> Result<u8, Failure> {
        let inputs = files_of(description);
        let file =
            (!is_standard_input(path)).then_some(NewFile { option: "--write-srdf", path, force: self.force });
        if let Some(file) = &file {
            folder_of(file.path)?;
            file.may_be_written(&inputs)?;
        }
        let sampling = Sampling { samples: self.samples as usize, seed: self.seed };
        let pairs = waiting(printer, "measuring pairs", || suggest_disabled(description, sampling))
            .map_err(|error| Diagnostic::error(codes::clearance::SHAPE, error.to_string()))?;
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
}
