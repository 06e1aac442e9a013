//! `calibrate --same-point`: corrections from configurations in which the tool is at one point.

use std::path::PathBuf;

use congruent::{
    calibration::{
        CalibrationOptions,
        same_point::{
            SamePointFile, SamePointOptions, SamePointReport, SamePointVerdict, calibrate_same_point,
        },
    },
    configurations::read_configurations,
    description::RobotDescription,
    text::same_point_text,
};

use crate::{
    failure::{Failure, NOTHING},
    terminal::{print::Printer, progress::waiting},
};

/// Files of configurations in which the tool is at one point.
#[derive(Debug, clap::Args)]
pub(super) struct SamePointArguments {
    /// In place of MEASUREMENTS, without any instrument: files of configurations (CSV, JSON Lines or JSON), in each of which the tool
    /// (or TCP) has touched one point that nobody has measured, such as a ball in a conical hole. The corrections bring the tool points
    /// of each file together. A point says nothing about the base and about the size of the arm, of which one length is held.
    #[arg(
        long,
        value_name = "FILE",
        num_args = 1..,
        conflicts_with_all = ["measurements", "loss", "noise", "next", "plot", "html", "out"]
    )]
    same_point: Vec<PathBuf>,
}

impl SamePointArguments {
    /// Whether such files are given.
    pub(super) fn is_given(&self) -> bool {
        !self.same_point.is_empty()
    }

    /// Reads the files, estimates and prints.
    pub(super) fn run(
        &self,
        description: &RobotDescription,
        options: &CalibrationOptions,
        printer: &Printer,
    ) -> Result<u8, Failure> {
        let mut files = Vec::with_capacity(self.same_point.len());
        for path in &self.same_point {
            let read = read_configurations(path, &description.robot)?;
            printer.warnings(None, read.warning.as_slice());
            files.push(SamePointFile { path: path.clone(), rows: read.entries });
        }
        let options = SamePointOptions {
            free: options.free.clone(),
            hold: options.hold.clone(),
            threshold: options.threshold,
            seed: options.seed,
        };
        let estimate = || calibrate_same_point(description, &files, &options);
        let report: SamePointReport = waiting(printer, "calibrating", estimate)?;
        printer.result(&report, same_point_text)?;
        Ok(match report.verdict {
            SamePointVerdict::Explained | SamePointVerdict::NoImprovement => 0,
            SamePointVerdict::Unverifiable | SamePointVerdict::NothingIdentified => NOTHING,
        })
    }
}
