//! One scenario that runs, and what a batch says of it.

use std::path::PathBuf;

use congruent::{
    PreparedScenario,
    input::{Diagnostic, display::listed},
    monitors::verdict::Status,
    results::{
        ExecuteError, Options,
        files::FolderError,
        missing_files,
        report::{Reason, RunReport, TestCase, TestResult, TestSuite, lines},
    },
    run_scenario,
    text::run_text,
};
use serde::{Serialize, Serializer};

use crate::{
    batch::BatchReport,
    codes,
    failure::{BROKEN, Failure, unwritable},
    terminal::{print::Printer, progress::ProgressLines},
};

/// A scenario that ran.
pub(crate) struct RunAnswer {
    pub(crate) report: RunReport,
    /// Where its results are, or why they are not all on disk.
    pub(crate) results: Result<PathBuf, String>,
    /// Files that could not be completed, as on a full disk.
    pub(crate) missing: Vec<&'static str>,
    /// Whether it ran in an earlier call.
    pub(crate) is_kept: bool,
}

impl Serialize for RunAnswer {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.report.serialize(serializer)
    }
}

impl BatchReport for RunAnswer {
    fn exit_code(&self) -> u8 {
        if self.results.is_ok() { self.report.exit_code } else { BROKEN }
    }

    fn text(&self) -> String {
        let results = match &self.results {
            Ok(folder) if self.is_kept => {
                format!("kept from an earlier call, results in {}", folder.display())
            }
            Ok(folder) if self.missing.is_empty() => format!("results in {}", folder.display()),
            Ok(folder) => format!("results in {}, without {}", folder.display(), listed(&self.missing)),
            Err(_) => "results are not all on disk".to_owned(),
        };
        format!("{}  {results}\n", run_text(&self.report))
    }

    fn one_line(&self) -> Option<String> {
        let line = run_text(&self.report).lines().next()?.to_owned();
        let failed = self.report.checks_failed_first().into_iter().find(|check| check.status == Status::Fail);
        let found = failed.and_then(|check| lines(check).into_iter().next());
        Some(found.map_or_else(|| line.clone(), |found| format!("{line}: {found}")))
    }

    fn test_suite(&self, _: &str) -> TestSuite {
        let mut suite = self.report.test_suite();
        if let Err(message) = &self.results {
            let reason = Reason { kind: "machine".to_owned(), message: message.clone() };
            let result = TestResult::Error(reason);
            suite.cases.push(TestCase {
                name: "results".to_owned(),
                result,
                output: String::new(),
                place: None,
                further: Vec::new(),
            });
        }
        suite
    }
}

/// Runs a scenario and writes its results.
pub(crate) fn run_one(
    scenario: &PreparedScenario,
    options: &Options<'_>,
    progress: &ProgressLines,
) -> Result<RunAnswer, Failure> {
    let setup = &scenario.setup;
    let progress = progress.start_run(setup);
    match run_scenario(scenario, options, &|stage| progress.stage(stage)) {
        Ok((report, folder)) => {
            let missing = missing_files(setup, options, &folder);
            Ok(RunAnswer { report, results: Ok(folder.path().to_owned()), missing, is_kept: false })
        }
        Err(ExecuteError::Lost { report, source }) => {
            Printer::explain(setup.path.as_deref(), &Failure::Machine(source.to_string()));
            let results = Err(source.to_string());
            Ok(RunAnswer { report: *report, results, missing: Vec::new(), is_kept: false })
        }
        Err(ExecuteError::Folder(error)) => Err(no_folder(error)),
        Err(ExecuteError::Output(error)) => Err(no_folder(error.into())),
        Err(error) => Err(Diagnostic::error(congruent::codes::run::CANNOT_RUN, error.to_string()).into()),
    }
}

/// Why there is no folder for results, and what to do.
pub(crate) fn no_folder(error: FolderError) -> Failure {
    let help = match error {
        FolderError::Output(error) => {
            return unwritable(&error, "choose a folder that can be written with --out");
        }
        FolderError::InUse { .. } => "wait for it, or give another folder with --out",
        _ => "give another folder with --out",
    };
    Diagnostic::error(codes::run::OUTPUT, error.to_string()).with_help(help).into()
}
