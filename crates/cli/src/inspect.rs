//! `congruent inspect`: what a recording holds, and its verdict.

use std::path::{Path, PathBuf};

use crate::{
    batch::{Batch, BatchReport},
    ci::CiArguments,
    failure::{FAILED, Failure},
    print::Printer,
};
use congruent::{
    description::Diagnostic,
    recording::{RecordingSummary, inspect},
    twin::report::{Reason, TestResult, TestSuite},
};

/// What recordings hold: verdict, timelines, entities, statistics of their scalars.
///
/// The exit code is that of the recorded run; 2 if a file is cut off, corrupt or no recording, 4 without a verdict. Of
/// several recordings it is the worst.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Recordings (.rrd).
    #[arg(required = true)]
    recordings: Vec<PathBuf>,
    #[command(flatten)]
    ci: CiArguments,
}

impl BatchReport for RecordingSummary {
    fn exit_code(&self) -> u8 {
        self.exit_code
    }

    fn text(&self) -> String {
        self.to_string()
    }

    fn test_suite(&self, input: &str) -> TestSuite {
        let reason = Reason { kind: "recording".to_owned(), message: self.reason.clone() };
        let result = match self.exit_code {
            0 => TestResult::Passed,
            FAILED => TestResult::Failed(reason),
            _ => TestResult::Error(reason),
        };
        TestSuite::of_case(input, "verdict", result)
    }
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let batch = Batch::begin(&arguments.recordings, &arguments.ci, printer)?;
    let read = |path: &Path| {
        inspect(path).map_err(|error| Diagnostic::error("inspect::recording", error.to_string()).into())
    };
    let recordings = arguments.recordings.iter();
    batch.finish(recordings.map(|path| batch.answer(path, || read(path))).collect())
}
