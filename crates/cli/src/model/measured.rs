//! `congruent check --measurements`: the model against measured poses or points.

use std::path::{Path, PathBuf};

use congruent::{
    calibration::{
        CalibrationOptions, MeasuredCheck, MeasuredCheckOptions, MeasuredVerdict, check_measured,
        measurements::read_measurements, needed_coordinates,
    },
    description::{RobotDescription, load_robot_with},
    input::Findings,
    measured_headline, measured_suite,
    results::report::TestSuite,
    text::{layout::visible_path, measured_text},
};
use serde::{Serialize, Serializer};

use crate::{
    batch::{Answer, Batch, BatchReport},
    ci::CiArguments,
    failure::{FAILED, Failure},
    input::{AccessArguments, ChainArguments, files_of},
    model::camera::CameraArgument,
    output::file::refuse_same,
    terminal::{print::Printer, progress::waiting},
    tolerance::ToleranceArgument,
};

/// The measurements that a robot is compared with.
#[derive(Debug, clap::Args)]
pub(super) struct MeasuredArguments {
    /// Compare the model with the measured poses or points of this file, which has the format of congruent calibrate, and
    /// with nothing else: the table if there is one, otherwise the URDF. Needs --tolerance. Exit code 1 if a row is
    /// beyond it.
    #[arg(
        long,
        value_name = "FILE",
        conflicts_with_all = ["against", "changed", "configurations", "table", "plot", "fix", "overrides", "strict", "basics", "html"]
    )]
    measurements: Option<PathBuf>,
    /// With --measurements: fit the pose of the base, of the tool, or single corrections of them such as base.yaw before
    /// the comparison.
    #[arg(long, value_delimiter = ',', requires = "measurements", value_name = "FRAME")]
    free: Vec<String>,
    #[command(flatten)]
    camera: CameraArgument,
}

/// The other options of `check` that this comparison has.
pub(super) struct MeasuredCall<'a> {
    pub(super) robots: &'a [PathBuf],
    pub(super) chain: &'a ChainArguments,
    pub(super) access: &'a AccessArguments,
    pub(super) ci: &'a CiArguments,
    pub(super) tolerance: Option<ToleranceArgument>,
}

/// The comparison of one robot.
struct ComparedWithMeasured {
    report: MeasuredCheck,
    description: RobotDescription,
}

impl Serialize for ComparedWithMeasured {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.report.serialize(serializer)
    }
}

impl BatchReport for ComparedWithMeasured {
    fn exit_code(&self) -> u8 {
        match self.report.verdict {
            MeasuredVerdict::Agree => 0,
            MeasuredVerdict::Disagree => FAILED,
        }
    }

    fn text(&self) -> String {
        measured_text(&self.report, &self.description.robot)
    }

    fn one_line(&self) -> Option<String> {
        Some(format!("{}: {}", self.report.file, measured_headline(&self.report)))
    }

    fn test_suite(&self, input: &str) -> TestSuite {
        measured_suite(input, &self.report)
    }
}

impl MeasuredArguments {
    /// The file, if robots are compared with measurements.
    pub(super) fn file(&self) -> Option<&Path> {
        self.measurements.as_deref()
    }

    pub(super) fn run(&self, file: &Path, call: &MeasuredCall<'_>, printer: &Printer) -> Result<u8, Failure> {
        refuse_same(call.ci.outputs())?;
        let batch = Batch::begin(call.robots, call.ci, printer)?;
        let answers: Vec<Answer<ComparedWithMeasured>> = call
            .robots
            .iter()
            .map(|path| batch.answer(path, || self.compared(path, file, call, &batch)))
            .collect();
        batch.finish(answers)
    }

    fn compared(
        &self,
        path: &Path,
        file: &Path,
        call: &MeasuredCall<'_>,
        batch: &Batch<'_>,
    ) -> Result<ComparedWithMeasured, Failure> {
        let description = call.chain.of(load_robot_with(path, &call.access.access()?)?)?;
        let tolerance = call.tolerance.unwrap_or_default();
        let (wrong, wide) = tolerance.examine(description.tolerance_scale());
        if !wrong.is_empty() {
            return Err(Findings::from(wrong).into());
        }
        batch.warn(path, &wide);
        let needed = needed_coordinates(&description)?;
        let rows = read_measurements(file, &description.robot, &needed)?;
        let mut inputs = files_of(&description);
        inputs.push(file.to_owned());
        batch.reads(&inputs)?;
        let options = MeasuredCheckOptions {
            tolerance: tolerance.requested(),
            free: self.camera.free(&self.free),
            camera: self.camera.mount(),
            threshold: CalibrationOptions::default().threshold,
        };
        let compare = || check_measured(&description, file, &rows, &options);
        let report = waiting(batch.printer(), &format!("checking {}", visible_path(path)), compare)?;
        batch.warn(path, &description.warnings);
        Ok(ComparedWithMeasured { report, description })
    }
}
