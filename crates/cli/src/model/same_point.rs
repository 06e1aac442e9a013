//! `calibrate --same-point`: corrections from configurations in which the tool is at one point.

use std::path::PathBuf;

use congruent::{
    calibration::{
        CalibrationOptions,
        same_point::{
            SamePointFile, SamePointOptions, SamePointReport, SamePointVerdict, calibrate_same_point,
            same_point_robot,
        },
    },
    configurations::read_configurations,
    description::RobotDescription,
    text::{same_point_robot_comments, same_point_text},
};

use crate::{
    failure::{FAILED, Failure, NOTHING},
    input::files_of,
    model::calibrated_robot::{Calibrated, OutArguments},
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
        conflicts_with_all = ["measurements", "loss", "noise", "next", "plot", "html"]
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
        out: &OutArguments,
        printer: &Printer,
    ) -> Result<u8, Failure> {
        let mut inputs = files_of(description);
        inputs.extend(self.same_point.iter().cloned());
        out.may_be_written(description, &inputs)?;
        let (mut files, mut read_files) = (Vec::new(), Vec::new());
        for path in &self.same_point {
            let read = read_configurations(path, &description.robot)?;
            printer.warnings(None, read.warning.as_slice());
            read_files.extend(read.input);
            files.push(SamePointFile { path: path.clone(), rows: read.entries });
        }
        let options = SamePointOptions {
            free: options.free.clone(),
            hold: options.hold.clone(),
            threshold: options.threshold,
            seed: options.seed,
        };
        let estimate = || calibrate_same_point(description, &files, &options);
        let mut report: SamePointReport = waiting(printer, "calibrating", estimate)?;
        let calibrated = Calibrated {
            description,
            corrected: &|| same_point_robot(description, &options, &report),
            comments: &|left_out| same_point_robot_comments(&report, &read_files, left_out),
            inputs: &inputs,
        };
        // The estimate is printed also where its robot cannot be written.
        let (written, refused) = match out.write(&calibrated, printer) {
            Ok(written) => (written, None),
            Err(refused) => (None, Some(refused)),
        };
        report.written = written;
        let is_unwritten = out.folder().is_some() && report.written.is_none() && refused.is_none();
        printer.result(&report, |report| {
            let text = same_point_text(report);
            if is_unwritten { text + &out.nothing_written() } else { text }
        })?;
        if let Some(refused) = refused {
            return Err(refused);
        }
        Ok(match report.verdict {
            SamePointVerdict::NoImprovement if is_unwritten => FAILED,
            SamePointVerdict::Unexplained => FAILED,
            SamePointVerdict::Explained | SamePointVerdict::NoImprovement => 0,
            SamePointVerdict::Unverifiable | SamePointVerdict::NothingIdentified => NOTHING,
        })
    }
}
