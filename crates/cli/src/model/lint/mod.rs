//! `congruent lint`: what is wrong or suspicious in files.

mod diff;
mod fix;
mod lines;
mod sarif;

use std::path::{Path, PathBuf};

use congruent::{
    LintReport, LintVerdict, lint_among,
    results::report::{CasePlace, Reason, TestResult, TestSuite},
    text::{layout::visible_path, lint_text},
};
use serde::Serialize;

use crate::{
    batch::{Answer, Batch, BatchReport},
    ci::CiArguments,
    explain,
    failure::{BAD_INPUT, FAILED, Failure},
    input::AccessArguments,
    sweep_plans::without_plans,
    terminal::print::{Format, Printer, text_options},
};

/// Reports errors and suspicious values in URDFs, SRDFs, robot files, scenarios, the files that these name, and
/// tables.
///
/// An SRDF is compared with the robot in the same call or folder, and so are tables of configurations, targets and
/// measurements.
/// Each finding has its place, a code that never changes, what to do, and what it blocks: kinematics, clearance or
/// physics. `[[lint.ignore]]` in robot.toml, with a reason, ignores warnings about what is intended. Exit codes: 0 no
/// error, 1 errors (with --strict also warnings), 2 a file cannot be read. `--format sarif` prints one SARIF document for
/// code hosts.
#[derive(Debug, clap::Args)]
#[command(override_usage = "congruent lint [OPTIONS] <FILES>...")]
#[expect(clippy::struct_excessive_bools, reason = "each is an option of the command line")]
pub(crate) struct Arguments {
    /// URDF, SRDF, robot file, folder with robot.toml, scenario, table (.json, .csv), or - for a URDF on standard input.
    #[arg(required_unless_present = "explain")]
    files: Vec<PathBuf>,
    /// The same as `congruent explain CODE`.
    #[arg(long, value_name = "CODE", conflicts_with = "files")]
    explain: Option<String>,
    /// Write the safe corrections and show the difference. A correction is safe if the file keeps its meaning, or if
    /// refused text has only one possible meaning. The findings printed are those that remain.
    #[arg(long)]
    fix: bool,
    /// Only show the difference; write nothing.
    #[arg(long, requires = "fix")]
    dry_run: bool,
    /// Warnings fail as errors do.
    #[arg(long)]
    strict: bool,
    #[command(flatten)]
    ci: CiArguments,
    #[command(flatten)]
    access: AccessArguments,
}

/// How often a file is corrected in one call.
const MOST_ROUNDS: usize = 4;

/// The report of one file, judged as the call asks.
#[derive(Serialize)]
struct Linted {
    #[serde(flatten)]
    report: LintReport,
    /// The file as it was named.
    #[serde(skip)]
    path: PathBuf,
    #[serde(skip)]
    strict: bool,
    /// What `--fix` has changed, or would change.
    #[serde(skip)]
    difference: String,
}

impl BatchReport for Linted {
    fn exit_code(&self) -> u8 {
        match self.report.verdict {
            LintVerdict::Clean => 0,
            LintVerdict::Warnings if !self.strict => 0,
            LintVerdict::Warnings | LintVerdict::Errors => FAILED,
            LintVerdict::Unreadable => BAD_INPUT,
        }
    }

    fn text(&self) -> String {
        lint_text(&self.report, &self.difference, &text_options())
    }

    fn one_line(&self) -> Option<String> {
        let text = self.text();
        Some(format!("{}: {}", visible_path(&self.path), text.lines().next_back()?))
    }

    fn test_suite(&self, input: &str) -> TestSuite {
        let said = self.report.findings.iter().map(|found| found.finding.to_string());
        let first = self.report.findings.first().map(|found| &found.finding);
        let reason = Reason {
            kind: first.map_or("lint", |found| &found.code).to_owned(),
            message: said.collect::<Vec<_>>().join("\n"),
        };
        let result = match self.exit_code() {
            0 => TestResult::Passed,
            FAILED => TestResult::Failed(reason),
            _ => TestResult::Error(reason),
        };
        let mut suite = TestSuite::with_case(input, "lint", result);
        let place = first.and_then(|found| CasePlace::if_known(found.file.as_deref(), found.line));
        suite.cases.iter_mut().for_each(|case| case.place.clone_from(&place));
        suite
    }
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    if let Some(code) = &arguments.explain {
        return explain::run(code, printer);
    }
    let files = without_plans(&arguments.files, printer);
    let batch = Batch::begin(&files, &arguments.ci, printer)?;
    let access = arguments.access.access()?;
    let linted = |path: &Path| {
        let own = access.fresh();
        let mut report = lint_among(path, &files, &own);
        let (mut difference, mut fixed) = (String::new(), Vec::new());
        // What was refused hides other findings, which the next round corrects.
        for _ in 0..MOST_ROUNDS {
            if !arguments.fix || report.fixes.is_empty() {
                break;
            }
            difference += &fix::difference(&report.fixes);
            if arguments.dry_run || !fix::write(&report.fixes)? {
                break;
            }
            fixed.append(&mut report.fixes);
            report = lint_among(path, &files, &own);
        }
        fixed.append(&mut report.fixes);
        report.fixes = fixed;
        let read: Vec<PathBuf> = own.files().into_iter().map(|file| file.path).collect();
        batch.reads(&read).map_err(Failure::from)?;
        Ok(Linted { report, path: path.to_owned(), strict: arguments.strict, difference })
    };
    let answers: Vec<Answer<Linted>> = files.iter().map(|path| batch.answer(path, || linted(path))).collect();
    if printer.format() == Format::Sarif {
        return batch.finish_as(answers, |answers| {
            let found = answers.iter().filter_map(|answer| answer.report().ok());
            let reports: Vec<(&Path, &LintReport)> =
                found.map(|linted| (linted.path.as_path(), &linted.report)).collect();
            sarif::document(&reports)
        });
    }
    batch.finish(answers)
}
